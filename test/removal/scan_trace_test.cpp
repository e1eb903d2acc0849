// SPDX-License-Identifier: BSD-3-Clause
#include "scan_trace.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "small_world.hpp"

namespace rhmap {
namespace {

using test::emptyMap;
using test::kCube;
using test::pointsIn;

using Cube = std::tuple<int, int, int>;

class TracedRegionSizes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Cubes, TracedRegionSizes, testing::Values(4, 8, 16));

TEST_P(TracedRegionSizes, CountTheScansThatHitEachCube) {
  RegionMap map = emptyMap(GetParam());
  test::RandomCubes random(7, 12);
  std::map<Cube, int> hits;
  constexpr int kFirm = 3;
  for (std::uint32_t scan = 1; scan <= 8; ++scan) {
    std::vector<OcTreeKey> cubes;
    for (int i = 0; i < 3000; ++i) cubes.push_back(random());  // with repetitions
    std::set<Cube> now;
    std::map<std::pair<int, int>, std::tuple<int, int, int>> columns;  // points, lowest, highest
    for (const OcTreeKey& c : cubes) {
      now.insert({c[0], c[1], c[2]});
      auto& [n, low, high] =
          columns.try_emplace({c[0] >> map.bits(), c[1] >> map.bits()}, 0, 1 << 16, -1).first->second;
      ++n, low = std::min(low, int{c[2]}), high = std::max(high, int{c[2]});
    }
    const auto before = hits;
    for (const Cube& c : now) ++hits[c];
    const ScanTrace trace = test::trace(map, pointsIn(cubes), {kTreeMaxVal, kTreeMaxVal, kTreeMaxVal}, scan,
                                        {.reach = 50, .resolution = kCube, .firm = kFirm});
    ASSERT_EQ(trace.columns.size(), columns.size());
    for (const ScanColumn& c : trace.columns) {
      const auto& [n, low, high] = columns.at({c.column->x, c.column->y});
      EXPECT_EQ(c.points, n);
      EXPECT_EQ(c.z_min, low);
      EXPECT_EQ(c.z_max, high);
    }
    for (const auto& [at, count] : hits) {
      const auto& [x, y, z] = at;
      const OcTreeKey cube(static_cast<key_type>(x), static_cast<key_type>(y), static_cast<key_type>(z));
      const Region* region = map.regionOf(cube);
      const Octant& octant = region->octant(map.octantOf(cube));
      const std::uint64_t mask = maskOf(bitOf(cube));
      ASSERT_TRUE(octant.occupied & mask);
      EXPECT_EQ(historyOf(octant).hits[static_cast<std::size_t>(bitOf(cube))], count);
      EXPECT_EQ((octant.firm & mask) != 0, count >= kFirm);
      if (!region->isHitBy(scan, map.octantOf(cube))) {
        EXPECT_EQ(now.count(at), 0U);
        continue;
      }
      EXPECT_EQ((octant.hit & mask) != 0, now.count(at) == 1);
      EXPECT_EQ((octant.fresh & mask) != 0, now.count(at) == 1 && before.count(at) == 0);
    }
  }
}

TEST(ScanTrace, LeavesWhatIsOutOfReachOutOfTheColumns) {
  RegionMap map = emptyMap();
  const OcTreeKey low(kTreeMaxVal, kTreeMaxVal, kTreeMaxVal), high(kTreeMaxVal, kTreeMaxVal, kTreeMaxVal + 2);
  ScanPoints points = pointsIn({low, high, low});
  points.range[1] = 60;
  const ScanTrace trace = test::trace(map, points, low, 1, {.reach = 50, .resolution = kCube});
  ASSERT_EQ(trace.columns.size(), 1U);
  EXPECT_EQ(trace.columns[0].points, 2);
  EXPECT_EQ(trace.columns[0].z_min, low[2]);
  EXPECT_EQ(trace.columns[0].z_max, low[2]);
  EXPECT_TRUE(test::isOccupied(map, high));
}

TEST(ScanTrace, WithoutInsertionOnlyMarks) {
  RegionMap map = emptyMap();
  const OcTreeKey cube(kTreeMaxVal, kTreeMaxVal, kTreeMaxVal);
  test::trace(map, pointsIn({cube}), cube, 1, {.insert = false});
  const Octant& octant = map.regionOf(cube)->octant(map.octantOf(cube));
  EXPECT_EQ(octant.occupied, 0U);
  EXPECT_EQ(octant.hit, maskOf(bitOf(cube)));
}

}  // namespace
}  // namespace rhmap
