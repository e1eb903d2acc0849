// SPDX-License-Identifier: BSD-3-Clause
#include "leftovers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "small_world.hpp"

namespace rhmap {
namespace {

using test::cornerOf;
using test::cubeAt;
using test::emptyMap;
using test::isOccupied;
using test::isWithin;
using test::kCube;
using test::occupy;

/// A cube that one scan has hit.
Octant& hit(RegionMap& map, const OcTreeKey& cube) {
  Octant& octant = occupy(map, cube);
  historyOf(map.regionOf(cube)->octant(map.octantOf(cube))).hits[static_cast<std::size_t>(bitOf(cube))] = 1;
  return octant;
}

void takeOut(RegionMap& map, const OcTreeKey& cube) {
  occupy(map, cube);
  map.regionOf(cube)->remove(map.octantOf(cube), maskOf(bitOf(cube)));
}

/// What is left of an octant of which `gone` cubes have been taken out, with so many firm ones beside it.
std::size_t leftOf(int gone, int firm = 0, const LeftoverConfig& config = {}) {
  RegionMap map = emptyMap();
  const OcTreeKey corner = cubeAt(0, 0, 0);
  for (int bit = 0; bit < 64; ++bit)
    bit < gone ? takeOut(map, cubeOf(corner, bit)) : void(hit(map, cubeOf(corner, bit)));
  for (int i = 0; i < firm; ++i) {
    const OcTreeKey cube = cubeAt(4, i % 4, i / 4);
    occupy(map, cube).firm |= maskOf(bitOf(cube));
  }
  RemovalResult result;
  removeLeftovers(map, std::array{corner}, 0, config, kCube, {.scan = 1}, result);
  const Octant& octant = map.regionOf(corner)->octant(map.octantOf(corner));
  return static_cast<std::size_t>(std::popcount(octant.occupied));
}

TEST(Leftovers, GoIfMostOfWhatWasThereHasGone) {
  LeftoverConfig config{.reach = 0.3, .least = 0.1, .share = 0.6, .others = 0.3};
  EXPECT_EQ(leftOf(20, 0, config), 0U);  // 20 of 20 + 0.3 * 44 = 33.2, which is more than 0.6
  EXPECT_EQ(leftOf(19, 0, config), 45U);
  EXPECT_EQ(leftOf(32, 11, config), 0U);  // 32 of 32 + 0.3 * 32 + 11 = 52.6
  EXPECT_EQ(leftOf(32, 12, config), 32U);
  config.share = 0.59;
  EXPECT_EQ(leftOf(32, 12, config), 0U);
  EXPECT_EQ(leftOf(60, 0, {.least = 0.6}), 0U);
  EXPECT_EQ(leftOf(59, 0, {.least = 0.6}), 5U);
}

TEST(Leftovers, AreNotOfTheGroundNorFirmNorHitByThisScan) {
  RegionMap map = emptyMap();
  const OcTreeKey corner = cubeAt(0, 0, 0);
  for (int bit = 8; bit < 64; ++bit) takeOut(map, cubeOf(corner, bit));
  for (int bit = 0; bit < 4; ++bit) hit(map, cubeOf(corner, bit));
  Region* region = map.regionOf(corner);
  Octant& octant = region->octant(map.octantOf(corner));
  octant.ground = 1, octant.firm = 2, octant.hit = 4;
  region->scan = 7, region->hit_octants = maskOf(static_cast<int>(map.octantOf(corner)));
  RemovalResult result;
  removeLeftovers(map, std::array{corner}, 0, {}, kCube, {.scan = 7}, result);
  EXPECT_EQ(octant.occupied, 7U);
  ASSERT_EQ(result.removed.size(), 1U);
  EXPECT_EQ(result.removed[0].corner, corner);
  EXPECT_EQ(result.removed[0].cubes, 8U);
  EXPECT_FALSE(result.removed[0].seen_through);
  removeLeftovers(map, std::array{corner}, 0, {}, kCube, {.scan = 7, .protect = false}, result);
  EXPECT_EQ(octant.occupied, 3U);
}

TEST(Leftovers, AreNothingThatWasReadFromTheTree) {
  for (const bool was_hit : {true, false}) {
    RegionMap map = emptyMap();
    const OcTreeKey corner = cubeAt(0, 0, 0);
    for (int bit = 1; bit < 64; ++bit) takeOut(map, cubeOf(corner, bit));
    was_hit ? hit(map, corner) : occupy(map, corner);
    RemovalResult result;
    removeLeftovers(map, std::array{corner}, 0, {}, kCube, {.scan = 1}, result);
    EXPECT_EQ(isOccupied(map, corner), !was_hit);
  }
}

TEST(Leftovers, AreFoundInTurnWhereverCubesHaveGone) {
  constexpr int kInterval = 5, kColumns = 12;  // in x; all cubes of an octant have gone but one
  RegionMap map = emptyMap();
  const auto corner = [](int i) { return cubeAt(8 * i, 0, 0); };
  for (int i = 0; i < kColumns; ++i) {
    hit(map, corner(i));
    for (int bit = 1; bit < 64; ++bit) takeOut(map, cubeOf(corner(i), bit));
  }
  RemovalResult result;
  std::set<int> left;
  for (int i = 0; i < kColumns; ++i) left.insert(i);
  for (std::uint32_t scan = 1; scan <= kInterval; ++scan) {
    removeLeftovers(map, {}, kInterval, {}, kCube, {.scan = scan}, result);
    std::erase_if(
        left, [&](int i) { return (map.regionOf(corner(i))->x + map.regionOf(corner(i))->y + scan) % kInterval == 0; });
    for (int i = 0; i < kColumns; ++i) EXPECT_EQ(isOccupied(map, corner(i)), left.contains(i)) << scan;
  }
  EXPECT_TRUE(left.empty());

  hit(map, corner(3));
  removeLeftovers(map, {}, 0, {}, kCube, {.scan = 6}, result);
  EXPECT_TRUE(isOccupied(map, corner(3)));
  removeLeftovers(map, {}, 1, {}, kCube, {.scan = 6}, result);
  EXPECT_FALSE(isOccupied(map, corner(3)));
}

TEST(Leftovers, AreNotOnTheOtherSideOfTheTree) {
  RegionMap map = emptyMap();
  const OcTreeKey here(0, 0, 0), opposite(0xfffc, 0, 0);
  for (const OcTreeKey& corner : {here, opposite}) {
    hit(map, corner);
    for (int bit = 1; bit < 64; ++bit) takeOut(map, cubeOf(corner, bit));
  }
  RemovalResult result;
  removeLeftovers(map, std::array{here}, 0, {}, kCube, {.scan = 1}, result);
  EXPECT_FALSE(isOccupied(map, here));
  EXPECT_TRUE(isOccupied(map, opposite));
}

TEST(Leftovers, AreWhatAPlainCountFinds) {
  for (const int size : {4, 8, 16}) {
    RegionMap map = emptyMap(size);
    std::mt19937 random(static_cast<unsigned>(size));
    test::RandomCubes somewhere(11, 14);
    std::set<OcTreeKey, decltype([](const OcTreeKey& a, const OcTreeKey& b) {
               return std::tie(a[0], a[1], a[2]) < std::tie(b[0], b[1], b[2]);
             })>
        known;
    std::vector<OcTreeKey> gone, firm, others, changed;
    for (int i = 0; i < 6000; ++i) {
      const OcTreeKey cube = somewhere();
      if (!known.insert(cube).second) continue;
      // Where x is larger, more has gone.
      const bool goes = static_cast<int>(random() % 28) < cube[0] - kTreeMaxVal + 20;
      if (goes) {
        takeOut(map, cube);
        gone.push_back(cube);
        if (random() % 40 == 0) changed.push_back(cornerOf(cube));
      } else if (random() % 6 == 0) {
        occupy(map, cube).firm |= maskOf(bitOf(cube));
        firm.push_back(cube);
      } else {
        hit(map, cube);
        others.push_back(cube);
      }
    }
    const LeftoverConfig config;
    const auto goes = [&](const OcTreeKey& cube) {
      const OcTreeKey corner = cornerOf(cube);
      const auto near = [&](const OcTreeKey& other) { return isWithin(other, corner, 3); };
      const auto moved = static_cast<double>(std::count_if(gone.begin(), gone.end(), near));
      const auto stand = static_cast<double>(std::count_if(firm.begin(), firm.end(), near));
      const auto more = static_cast<double>(std::count_if(others.begin(), others.end(), near));
      const bool is_beside =
          std::any_of(changed.begin(), changed.end(), [&](const OcTreeKey& at) { return isWithin(corner, at, 4); });
      return is_beside && moved >= config.least / (kCube * kCube) &&
             moved >= config.share * (moved + stand + config.others * more);
    };
    std::vector<OcTreeKey> expected;
    std::copy_if(others.begin(), others.end(), std::back_inserter(expected), goes);
    RemovalResult result;
    removeLeftovers(map, changed, 0, config, kCube, {.scan = 1}, result);
    EXPECT_GT(expected.size(), 100U);
    EXPECT_GT(others.size(), expected.size() + 100);
    for (const OcTreeKey& cube : others)
      ASSERT_EQ(isOccupied(map, cube), std::find(expected.begin(), expected.end(), cube) == expected.end());
    for (const OcTreeKey& cube : firm) ASSERT_TRUE(isOccupied(map, cube));
    std::size_t removed = 0;
    for (const RemovedCubesOf& of : result.removed) removed += static_cast<std::size_t>(std::popcount(of.cubes));
    EXPECT_EQ(removed, expected.size());
  }
}

}  // namespace
}  // namespace rhmap
