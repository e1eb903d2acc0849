// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/ray_walk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <random>

#include "oracle.hpp"
#include "rhmap/octree/octree.hpp"
#include "rhmap/octree/scan_marking.hpp"
#include "targets.hpp"

namespace rhmap {
namespace {

using Cells = std::map<std::uint64_t, bool>;  // cell word -> hit

Cells cellsOf(const ScanMasks& masks) {
  Cells cells;
  masks.forEachCell([&](const OcTreeKey& key, bool hit) { cells[cell_word::fromKey(key)] = hit; });
  return cells;
}

TEST(CellWord, GivesTheKeyBackAndStepsAlongEachAxis) {
  std::mt19937 random(5);
  for (int i = 0; i < 100000; ++i) {
    const OcTreeKey key(static_cast<key_type>(random()), static_cast<key_type>(random()),
                        static_cast<key_type>(random()));
    const std::uint64_t word = cell_word::fromKey(key);
    ASSERT_EQ(cell_word::toKey(word), key);
    for (unsigned axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        OcTreeKey next = key;
        next[axis] = static_cast<key_type>(next[axis] + step);
        ASSERT_EQ(cell_word::toKey(cell_word::advance(word, cell_word::kAxis[axis],
                                                      cell_word::stepAlong(static_cast<int>(axis), step))),
                  next);
      }
  }
}

/// Rays from one origin: short and long ones, along axes and diagonals (ties), from borders of cells.
octomap::Pointcloud difficultEnds(const point3d& origin, double resolution, std::mt19937& random) {
  octomap::Pointcloud ends;
  const auto r = static_cast<float>(resolution);
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        for (const int n : {1, 2, 7, 8, 9, 300})
          ends.push_back(origin + point3d(static_cast<float>(x * n) * r, static_cast<float>(y * n) * r,
                                          static_cast<float>(z * n) * r));
  std::uniform_real_distribution<float> far(-400 * r, 400 * r);
  std::uniform_real_distribution<float> near(-4 * r, 4 * r);
  for (int i = 0; i < 400; ++i) ends.push_back(origin + point3d(far(random), far(random), far(random)));
  for (int i = 0; i < 400; ++i) ends.push_back(origin + point3d(near(random), near(random), near(random)));
  ends.push_back(origin + point3d(0, 0, 1e6F));
  return ends;
}

class RayWalkOn : public test::OnTarget {};

TEST_P(RayWalkOn, MarksTheCellsOfOctomapsComputeUpdate) {
  std::mt19937 random(3);
  for (const double resolution : {0.05, 0.1, 0.25}) {
    const KeySpace keys(resolution);
    test::OctomapOracle oracle(resolution);
    for (const point3d& origin : {point3d(0, 0, 0), point3d(0.05F, -0.1F, 0.2F), point3d(-12.345F, 7.77F, 1.5F)}) {
      const octomap::Pointcloud ends = difficultEnds(origin, resolution, random);
      for (const double max_range : {-1.0, 30 * resolution}) {
        octomap::KeySet free, occupied;
        oracle.computeUpdate(ends, origin, free, occupied, max_range);
        Cells expected;
        for (const auto& key : free) expected[cell_word::fromKey(key)] = false;
        for (const auto& key : occupied) expected[cell_word::fromKey(key)] = true;
        for (const int threads : {1, 3}) {
          ScanCounts counts;
          const ScanMasks masks =
              markScan(keys, ends, origin, {.max_range = max_range, .num_threads = threads}, counts);
          ASSERT_TRUE(cellsOf(masks) == expected) << resolution << " m, range " << max_range << ", " << threads;
          ASSERT_EQ(counts.points, ends.size());
        }
      }
    }
  }
}

TEST_P(RayWalkOn, WalksBatchesOfEverySizeToTheEnd) {
  const KeySpace keys(0.1);
  const point3d origin(0.01F, 0.02F, 0.03F);
  std::mt19937 random(9);
  const octomap::Pointcloud ends = difficultEnds(origin, 0.1, random);
  auto batch = std::make_unique<RayBatch>();
  for (unsigned rays = 0; rays <= 40; ++rays) {
    batch->clear();
    Cells expected;
    for (unsigned i = 0; i < rays; ++i) {
      RaySegment ray;
      if (startSegment(keys, origin, ends[200 + 13 * i], ray) != RayStart::kRay) continue;
      batch->add(ray);
      forEachRayKey(keys, origin, ends[200 + 13 * i],
                    [&](const OcTreeKey& k) { expected[cell_word::fromKey(k)] = false; });
    }
    ScanMasks masks;
    walkRays(*batch, masks);
    ASSERT_TRUE(cellsOf(masks) == expected) << rays << " rays";
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, RayWalkOn, testing::ValuesIn(test::targetsHere()), test::targetName);

TEST(RayKeys, AreOctomapsAlsoWhereARayMeetsEdgesAndCorners) {
  std::mt19937 random(8);
  for (const double resolution : {0.05, 0.1, 0.25}) {
    OcTree ours(resolution);
    test::OctomapOracle theirs(resolution);
    for (const point3d& origin :
         {point3d(0, 0, 0), ours.keyToCoord(OcTreeKey(32768, 32768, 32768)), point3d(1.3F, -2, 5)}) {
      const octomap::Pointcloud ends = difficultEnds(origin, resolution, random);
      ours.insertPointCloud(ends, origin);
      theirs.insertPointCloud(ends, origin);
      const auto r = static_cast<float>(resolution);
      const point3d beside = origin + point3d(7 * r, 8 * r, 20 * r);  // away from the many near ends
      KeyRay a, b;
      for (const point3d& end : ends) {
        ASSERT_EQ(ours.computeRayKeys(origin, end, a), theirs.computeRayKeys(origin, end, b)) << end;
        ASSERT_EQ(a.size(), b.size()) << end;
        ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin())) << end;
        for (const bool ignore : {false, true}) {
          point3d hit_a(9, 9, 9), hit_b(9, 9, 9);
          ASSERT_EQ(ours.castRay(beside, end - origin, hit_a, ignore, 37.3 * resolution),
                    theirs.castRay(beside, end - origin, hit_b, ignore, 37.3 * resolution));
          ASSERT_EQ(hit_a, hit_b) << end;
        }
      }
    }
  }
}

TEST(ScanMarking, CountsPointsThatAreNotFiniteOrOutside) {
  OcTree map(0.1);
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  octomap::Pointcloud scan;
  scan.push_back(1, 0, 0);
  scan.push_back(nan, 0, 0);
  scan.push_back(0, inf, 0);
  scan.push_back(0, 0, -inf);
  scan.push_back(5000, 0, 0);  // the tree ends at 3276.8 m
  for (const bool discretize : {false, true}) {
    map.clear();
    map.insertPointCloud(scan, point3d(0, 0, 0), -1, false, discretize);
    EXPECT_EQ(map.lastScan().points, 5U);
    EXPECT_EQ(map.lastScan().not_finite, 3U);
    EXPECT_NE(map.search(1.0, 0.0, 0.0), nullptr);
  }
  map.insertPointCloud(scan, point3d(0, 0, 0));
  EXPECT_EQ(map.lastScan().outside, 1U);
  map.insertPointCloud(octomap::Pointcloud(), point3d(0, 0, 0));
  EXPECT_EQ(map.lastScan().points, 0U);
  map.clear();
  map.insertPointCloud(scan, point3d(nan, 0, 0));  // an origin that is nowhere frees nothing
  EXPECT_EQ(map.getNumLeafNodes(), 1U);
}

TEST(ScanMarking, RaysAcrossTheWholeKeySpaceAreWalkedWithoutATable) {
  OcTree ours(0.1);
  test::OctomapOracle theirs(0.1);
  octomap::Pointcloud scan;
  scan.push_back(3276.75F, 0.02F, 0.01F);    // the last cell
  scan.push_back(-3276.75F, -0.02F, 0.01F);  // the first
  scan.push_back(0.02F, 3276.75F, 0.01F);
  ours.insertPointCloud(scan, point3d(0, 0, 0));
  theirs.insertPointCloud(scan, point3d(0, 0, 0));
  EXPECT_TRUE(test::otBytes(ours) == test::otBytes(theirs));
  EXPECT_GT(ours.size(), 90000U);
}

TEST(ScanMarking, DiscretizedPointsOutsideWrapAroundAsInOctomap) {
  OcTree ours(0.1);
  test::OctomapOracle theirs(0.1);
  octomap::Pointcloud scan;
  scan.push_back(3280.0F, 1.0F, 0.5F);
  scan.push_back(2.0F, 1.0F, 0.5F);
  ours.insertPointCloud(scan, point3d(0, 0, 0), -1, false, true);
  theirs.insertPointCloud(scan, point3d(0, 0, 0), -1, false, true);
  EXPECT_TRUE(test::otBytes(ours) == test::otBytes(theirs));
}

}  // namespace
}  // namespace rhmap
