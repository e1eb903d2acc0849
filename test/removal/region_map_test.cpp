// SPDX-License-Identifier: BSD-3-Clause
#include "region_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "rhmap/octree/octree.hpp"
#include "small_world.hpp"
#include "tree_reader.hpp"

namespace rhmap {
namespace {

using test::emptyMap;
using test::occupy;
using test::RandomCubes;

class RegionSizes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Cubes, RegionSizes, testing::Values(4, 8, 16));

TEST_P(RegionSizes, EachCubeHasOneBitInOneOctant) {
  const RegionMap map = emptyMap(GetParam());
  RandomCubes cubes(2, 2000);
  for (int i = 0; i < 5000; ++i) {
    const OcTreeKey cube = cubes();
    const Region region{.x = static_cast<key_type>(cube[0] >> map.bits()),
                        .y = static_cast<key_type>(cube[1] >> map.bits()),
                        .z = static_cast<key_type>(cube[2] >> map.bits()),
                        .column = nullptr};
    ASSERT_LT(map.octantOf(cube), map.octants());
    ASSERT_EQ(cubeOf(map.cornerOf(region, map.octantOf(cube)), bitOf(cube)), cube);
  }
}

TEST_P(RegionSizes, EachOctantIsALineOfTheCache) {
  RegionMap map = emptyMap(GetParam());
  RandomCubes cubes(5, 100);
  for (int i = 0; i < 200; ++i) {
    const OcTreeKey cube = cubes();
    occupy(map, cube);
    const Octant& octant = map.regionOf(cube)->octant(map.octantOf(cube));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(&octant) % 64, 0U);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(&historyOf(octant).hits) % 64, 0U);
  }
}

TEST_P(RegionSizes, HeightsFollowInsertionsAndRemovals) {
  RegionMap map = emptyMap(GetParam());
  RandomCubes cubes(3);
  std::set<std::tuple<int, int, int>> all;
  for (int i = 0; i < 300; ++i) {
    const OcTreeKey cube = cubes();
    occupy(map, cube);
    all.insert({cube[0], cube[1], cube[2]});
  }
  for (int round = 0; round < 2; ++round) {
    map.forEachColumn([&](Column& column) {
      for (const Region* region : column.regions) {
        int cubes = 0;
        for (std::size_t o = 0; o < map.octants(); ++o) cubes += std::popcount(region->octant(o).occupied);
        EXPECT_EQ(region->cubes, cubes);
      }
      map.refreshHeights(column);
      int low = 1 << 16, high = -1;
      for (const auto& [x, y, z] : all) {
        if (x >> map.bits() != column.x || y >> map.bits() != column.y) continue;
        low = std::min(low, z), high = std::max(high, z);
      }
      if (high < 0) {
        EXPECT_LT(column.h_max, column.h_min);
      } else {
        EXPECT_EQ(column.h_min, low);
        EXPECT_EQ(column.h_max, high);
      }
    });
    for (auto it = all.begin(); it != all.end();) {  // every second one goes
      const OcTreeKey cube(static_cast<key_type>(std::get<0>(*it)), static_cast<key_type>(std::get<1>(*it)),
                           static_cast<key_type>(std::get<2>(*it)));
      map.regionOf(cube)->remove(map.octantOf(cube), maskOf(bitOf(cube)));
      it = all.erase(it);
      if (it != all.end()) ++it;
    }
  }
}

TEST_P(RegionSizes, HeightsOfARegionAreThoseOfItsCubes) {
  RegionMap map = emptyMap(GetParam());
  RandomCubes cubes(16, 12);
  std::map<std::array<int, 3>, std::pair<int, int>> heights;
  for (int i = 0; i < 60; ++i) {
    const OcTreeKey cube = cubes();
    occupy(map, cube);
    auto& [low, high] =
        heights.try_emplace({cube[0] >> map.bits(), cube[1] >> map.bits(), cube[2] >> map.bits()}, cube[2], cube[2])
            .first->second;
    low = std::min(low, int{cube[2]}), high = std::max(high, int{cube[2]});
  }
  for (const auto& [at, expected] : heights) EXPECT_EQ(map.heights(*map.find(at[0], at[1], at[2])), expected);
}

TEST_P(RegionSizes, ForgetsExactlyTheColumnsThatAreFarther) {
  RegionMap map = emptyMap(GetParam());
  RandomCubes cubes(17, 500);
  std::set<std::pair<int, int>> all;
  for (int i = 0; i < 400; ++i) {
    const OcTreeKey cube = cubes();
    occupy(map, cube);
    all.insert({cube[0] >> map.bits(), cube[1] >> map.bits()});
  }
  const OcTreeKey centre(kTreeMaxVal + 100, kTreeMaxVal - 50, kTreeMaxVal);
  map.forgetBeyond(centre, 300);
  std::size_t kept = 0;
  for (const auto& [x, y] : all) {
    const int middle = map.size() / 2;
    const bool is_near =
        std::abs(x * map.size() + middle - centre[0]) <= 300 && std::abs(y * map.size() + middle - centre[1]) <= 300;
    EXPECT_EQ(map.find(x, y) != nullptr, is_near);
    kept += is_near;
  }
  EXPECT_EQ(map.numColumns(), kept);
  EXPECT_GT(kept, 50U);
  std::size_t visited = 0;
  map.forEachColumn([&](Column& column) { visited += all.count({column.x, column.y}); });
  EXPECT_EQ(visited, kept);
}

TEST_P(RegionSizes, ColumnsKnowThoseAroundThem) {
  RegionMap map = emptyMap(GetParam());
  RandomCubes cubes(18, 100);
  int known = 0;
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 300; ++i) occupy(map, cubes());
    map.forgetBeyond({kTreeMaxVal + 30, kTreeMaxVal, kTreeMaxVal}, 60);
    map.forEachColumn([&](Column& column) {
      for (std::size_t i = 0; i < kAround.size(); ++i) {
        EXPECT_EQ(column.around[i], map.find(column.x + kAround[i].x, column.y + kAround[i].y));
        known += column.around[i] != nullptr;
      }
    });
  }
  EXPECT_GT(known, 500);
}

TEST_P(RegionSizes, NothingIsLeftOfAnOctantThatWasForgotten) {
  RegionMap map = emptyMap(GetParam());
  const OcTreeKey cube(kTreeMaxVal, kTreeMaxVal, kTreeMaxVal);
  std::size_t memory = 0;
  for (int round = 0; round < 3; ++round) {
    const OcTreeKey other(static_cast<key_type>(cube[0] + 2000 * round), cube[1], cube[2]);
    Octant& octant = occupy(map, other);
    EXPECT_EQ(octant.occupied, maskOf(bitOf(other)));
    EXPECT_EQ(octant.firm | octant.ground | octant.hit, 0U);
    EXPECT_EQ(historyOf(octant).hits, Tally{});
    EXPECT_EQ(historyOf(octant).first, 0U);
    octant.firm = octant.ground = octant.hit = ~std::uint64_t{0};
    historyOf(octant).hits.fill(9);
    historyOf(octant).first = 5;
    for (std::size_t o = 0; o < map.octants(); ++o)
      EXPECT_EQ(map.regionOf(other)->knows(o), o == map.octantOf(other)) << o;
    if (round == 0) memory = map.memoryUsage();
    EXPECT_EQ(map.memoryUsage(), memory);  // that of the octant before
    map.forgetBeyond({0, 0, 0}, 0);
    EXPECT_EQ(map.regionOf(other), nullptr);
  }
}

/// Shows what readColumn() reads.
struct OpenTree : OcTree {
  using OcTree::OcTree;
  using OcTree::store_;
};

TEST_P(RegionSizes, AColumnIsReadFromTheTree) {
  OpenTree tree(0.1);
  RandomCubes cubes(4);
  for (int i = 0; i < 3000; ++i) tree.updateNode(cubes(), i % 3 != 0);
  for (key_type x = 0; x < 16; ++x)  // a pruned leaf of 16 cubes an edge, above it three of 8, and one of 4
    for (key_type y = 0; y < 16; ++y)
      for (key_type z = 0; z < 28; ++z)
        if (z < 16 || (z < 24 ? x < 8 || y < 8 : x < 4 && y < 4))
          tree.setNodeValue(OcTreeKey(static_cast<key_type>(kTreeMaxVal + x), static_cast<key_type>(kTreeMaxVal + y),
                                      static_cast<key_type>(kTreeMaxVal + 64 + z)),
                            2.0F);
  RegionMap map(GetParam(), [&](key_type x, key_type y, int size) {
    return readColumn(*tree.store_, tree.getOccupancyThresLog(), x, y, size);
  });
  std::size_t occupied = 0;
  for (int x = -24; x < 24; ++x) {
    for (int y = -24; y < 24; ++y) {
      map.getOrCreate(static_cast<key_type>((kTreeMaxVal + x) >> map.bits()),
                      static_cast<key_type>((kTreeMaxVal + y) >> map.bits()));
      for (int z = -24; z < 96; ++z) {
        const OcTreeKey cube(static_cast<key_type>(kTreeMaxVal + x), static_cast<key_type>(kTreeMaxVal + y),
                             static_cast<key_type>(kTreeMaxVal + z));
        const OcTreeNode* node = tree.search(cube);
        const bool expected = node != nullptr && tree.isNodeOccupied(node);
        ASSERT_EQ(test::isOccupied(map, cube), expected) << x << ' ' << y << ' ' << z;
        occupied += expected;
      }
    }
  }
  EXPECT_GT(occupied, 1000U);
}

TEST(RegionMap, ForgetsWhatIsFarAndReadsItAgain) {
  int reads = 0;
  RegionMap map(8, [&](key_type, key_type, int) {
    ++reads;
    return std::vector<CubesAt>();
  });
  const OcTreeKey here(kTreeMaxVal, kTreeMaxVal, kTreeMaxVal);
  map.getOrCreate(kTreeMaxVal >> 3, kTreeMaxVal >> 3);
  map.getOrCreate((kTreeMaxVal + 400) >> 3, kTreeMaxVal >> 3);
  map.forgetBeyond(here, 300);
  EXPECT_EQ(map.numColumns(), 1U);
  EXPECT_NE(map.find(kTreeMaxVal >> 3, kTreeMaxVal >> 3), nullptr);
  map.getOrCreate((kTreeMaxVal + 400) >> 3, kTreeMaxVal >> 3);
  EXPECT_EQ(reads, 3);
}

TEST(Octant, LayersAreThoseOfTheLowestAndTheHighestCube) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 10000; ++i) {
    std::uint64_t cubes = random() & random();
    if (i % 2 == 0) cubes &= random() & random() & random();
    if (cubes == 0) continue;
    int low = 4, high = -1;
    forEachBit(cubes, [&](int bit) {
      const int z = cubeOf({0, 0, 0}, bit)[2];
      low = std::min(low, z), high = std::max(high, z);
    });
    ASSERT_EQ(layersOf(cubes), std::pair(low, high)) << cubes;
  }
}

}  // namespace
}  // namespace rhmap
