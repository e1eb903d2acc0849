// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/removal/rh_map.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "street.hpp"

namespace rhmap {
namespace {

using test::bytes;
using test::hitCubes;
using test::isOccupied;
using test::keyOf;
using test::Scan;
using test::street;

TEST(RhMap, WorksWithAllProfilesAndSizesOfRegions) {
  for (const std::string_view profile : removalProfiles()) {
    for (const int size : {4, 8, 16}) {
      RemovalConfig config = removalProfile(profile);
      config.region_size = size;
      RhMap map(0.1, config);
      std::size_t removed = 0;
      for (std::size_t k = 0; k < 10; ++k) removed += map.insertScan(street()[k].points, street()[k].pose).removed;
      removed += map.finish().removed;
      EXPECT_GT(removed, 20U) << profile << ' ' << size;
      EXPECT_GT(map.size(), 10000U);
    }
  }
}

TEST(RhMap, WithNothingToRemoveIsWhatUpdateNodeMakes) {
  OcTree plain(0.1);
  RemovalConfig config = fastProfile();
  config.context.delta_1 = 0;
  config.back_end.enabled = false;
  for (std::size_t k = 0; k < 8; ++k)
    for (const auto& cube : hitCubes(plain, street()[k], config.min_range)) plain.updateNode(keyOf(cube), true);
  for (const int size : {4, 8, 16}) {
    config.region_size = size;
    RhMap map(0.1, config);
    for (std::size_t k = 0; k < 8; ++k) map.insertScan(street()[k].points, street()[k].pose);
    EXPECT_TRUE(bytes(map) == bytes(plain)) << size;
  }
}

TEST(RhMap, LooksBackWithoutTheVoid) {
  for (const bool looks_back : {true, false}) {
    RemovalConfig config;
    config.free_space.enabled = false;
    config.look_back.enabled = looks_back;
    config.look_back.stride = 2;
    RhMap map(0.1, config);
    std::size_t rejected = 0;
    for (std::size_t k = 0; k < 10; ++k) rejected += map.insertScan(street()[k].points, street()[k].pose).rejected;
    EXPECT_EQ(rejected > 0, looks_back);
  }
}

TEST(RhMap, IsTheSameWithAnyNumberOfThreadsAndInEachRun) {
  RemovalConfig config;
  config.carve = true;
  std::vector<std::string> maps;
  for (const int threads : {1, 1, 4}) {
    RhMap map(0.2, config);
    map.setNumThreads(threads);
    for (std::size_t k = 0; k < 10; ++k) map.insertScan(street()[k].points, street()[k].pose);
    map.finish();
    maps.push_back(bytes(map));
  }
  EXPECT_TRUE(maps[0] == maps[1]);
  EXPECT_TRUE(maps[0] == maps[2]);
}

TEST(RhMap, CarvesFreeSpaceAndKeepsWhatIsOccupied) {
  RemovalConfig config;
  RhMap ends(0.2, config);
  config.carve = true;
  RhMap carved(0.2, config);
  for (std::size_t k = 0; k < 10; ++k) {
    ends.insertScan(street()[k].points, street()[k].pose);
    carved.insertScan(street()[k].points, street()[k].pose);
  }
  std::size_t occupied = 0, free = 0;
  for (auto it = ends.begin_leafs(), end = ends.end_leafs(); it != end; ++it) {
    if (it.getSize() > 0.3) continue;
    ++occupied;
    ASSERT_TRUE(isOccupied(carved, it.getKey()));
  }
  for (auto it = carved.begin_leafs(), end = carved.end_leafs(); it != end; ++it) free += !carved.isNodeOccupied(*it);
  EXPECT_FALSE(bytes(ends) == bytes(carved));
  EXPECT_GT(occupied, 3000U);
  EXPECT_GT(free, 10000U);
}

TEST(RhMap, WithProtectionRemovesNoCubeThatTheScanHasHit) {
  RemovalConfig config = paperProfile();
  config.protect_hits = true;
  RhMap map(0.1, config);
  std::size_t removed = 0;
  for (std::size_t k = 0; k < 14; ++k) {
    const ScanReport report = map.insertScan(street()[k].points, street()[k].pose);
    const auto cubes = hitCubes(map, street()[k], config.min_range);
    EXPECT_EQ(report.inserted, cubes.size());
    for (const auto& cube : cubes) ASSERT_TRUE(isOccupied(map, keyOf(cube)));
    removed += report.removed;
  }
  EXPECT_GT(removed, 50U);
}

TEST(RhMap, MakesRemovedCubesFreeIfAskedAndOccupiedWhenHitAgain) {
  RemovalConfig config = fastProfile();
  config.context.delta_1 = 0.6;  // much is taken that comes again
  RhMap unknown(0.1, config);
  config.removed = RemovedCubes::kFree;
  RhMap free(0.1, config);
  for (const Scan& scan : street()) {
    const ScanReport report = free.insertScan(scan.points, scan.pose);
    EXPECT_EQ(report.removed, unknown.insertScan(scan.points, scan.pose).removed);
    std::size_t in_map = 0;
    for (const auto& cube : hitCubes(free, scan, config.min_range)) in_map += isOccupied(free, keyOf(cube));
    ASSERT_EQ(in_map, report.inserted);
  }
  EXPECT_EQ(free.finish().removed, unknown.finish().removed);
  std::size_t free_cubes = 0;
  for (auto it = free.begin_leafs(), end = free.end_leafs(); it != end; ++it) {
    if (it.getDepth() < free.getTreeDepth()) continue;
    const bool is_occupied = free.isNodeOccupied(*it);
    ASSERT_EQ(is_occupied, isOccupied(unknown, it.getKey()));
    if (is_occupied) continue;
    ++free_cubes;
    EXPECT_EQ(unknown.search(it.getKey()), nullptr);
  }
  EXPECT_GT(free_cubes, 100U);
}

TEST(RhMap, CanLookBackOnlyWithVisibility) {
  RemovalConfig config;
  config.visibility.enabled = false;
  RhMap map(0.1, config);
  for (std::size_t k = 0; k < 14; ++k) map.insertScan(street()[k].points, street()[k].pose);
  EXPECT_GT(map.size(), 10000U);
}

}  // namespace
}  // namespace rhmap
