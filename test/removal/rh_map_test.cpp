// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/removal/rh_map.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "street.hpp"

namespace rhmap {
namespace {

using test::hitCubes;
using test::insertAll;
using test::isOccupied;
using test::keyOf;
using test::Scan;
using test::score;
using test::simulate;
using test::street;

TEST(RhMap, KeepsTheStreetAndLosesTheTraffic) {
  RhMap map(0.1);
  insertAll(map, street());
  const auto [kept, gone] = score(map, street());
  EXPECT_GT(kept, 0.99);
  EXPECT_GT(gone, 0.90);
}

TEST(RhMap, TakesNothingFromAWorldThatStands) {
  const std::vector<Scan> scans = simulate("static", 20);
  for (const std::string_view profile : {"fast", "default"}) {
    RhMap map(0.1, removalProfile(profile));
    insertAll(map, scans);
    EXPECT_GT(score(map, scans).first, 0.997) << profile;
  }
}

TEST(RhMap, AfterEachScanItsHitsAreInTheMapButForThoseThatMove) {
  for (const std::string_view profile : {"fast", "default"}) {
    RhMap map(0.1, removalProfile(profile));
    for (std::size_t k = 0; k < 14; ++k) {
      const ScanReport report = map.insertScan(street()[k].points, street()[k].pose);
      std::size_t in_map = 0;
      const auto cubes = hitCubes(map, street()[k], map.config().min_range);
      for (const auto& cube : cubes) in_map += isOccupied(map, keyOf(cube));
      ASSERT_EQ(in_map, report.inserted) << profile << ' ' << k;
      ASSERT_EQ(report.inserted + report.rejected, cubes.size());
      ASSERT_EQ(report.points, street()[k].points.size());
    }
  }
}

TEST(RhMap, TakesLeftoversOfWhatItKeepsOut) {
  RemovalConfig config;  // in which nothing but the void and looking back takes anything out
  config.context.delta_1 = 0;
  config.evidence.everywhere = false;
  config.back_end.enabled = false;
  std::array<double, 2> gone{};
  for (const bool leftovers : {false, true}) {
    config.leftovers.enabled = leftovers;
    RhMap map(0.1, config);
    insertAll(map, street());
    gone[leftovers] = score(map, street()).second;
  }
  EXPECT_GT(gone[1] - gone[0], 0.025);  // 0.014 beside the cubes that the map had before alone
}

TEST(RhMap, TakesLeftoversAlsoInTurnAndAtTheEnd) {
  std::array<double, 2> before{};
  for (const bool often : {false, true}) {
    RemovalConfig config;
    config.leftovers.interval = often ? 1 : 1000000;
    config.back_end.enabled = false;
    RhMap map(0.1, config);
    for (const Scan& scan : street()) map.insertScan(scan.points, scan.pose);
    before[often] = score(map, street()).second;
    map.finish();
    const double after = score(map, street()).second;
    if (!often) {
      EXPECT_GT(after, before[often]);
    }
  }
  EXPECT_GT(before[true], before[false]);
}

TEST(RhMap, KeepsMoreOfWhatStands) {
  std::array<double, 2> kept{};
  for (const bool standing : {false, true}) {
    RemovalConfig config;
    config.standing.enabled = standing;
    RhMap map(0.1, config);
    insertAll(map, street());
    kept[standing] = score(map, street()).first;
  }
  EXPECT_GT(kept[true], kept[false]);
}

TEST(RhMap, CleansAMapThatWasRead) {
  RhMap dirty(0.1, [] {
    RemovalConfig config = fastProfile();
    config.context.delta_1 = 0;
    config.back_end.enabled = false;
    return config;
  }());
  insertAll(dirty, street());
  std::stringstream file;
  dirty.writeBinary(file);
  RhMap map(0.1);
  ASSERT_TRUE(map.readBinary(file));
  const std::size_t before = map.getNumLeafNodes();
  std::size_t removed = 0;
  for (const Scan& scan : street()) {
    const ScanReport report = map.removeDynamic(scan.points, scan.pose);
    EXPECT_EQ(report.inserted, 0U);
    removed += report.removed;
  }
  EXPECT_GT(removed, 1000U);
  EXPECT_LT(map.getNumLeafNodes(), before + 8 * removed);
  const auto [kept, gone] = score(map, street());
  EXPECT_GT(kept, 0.98);
  EXPECT_GT(gone, 0.4);
}

TEST(RhMap, HasGroundUnderTheCarrier) {
  RhMap map(0.1);
  for (std::size_t k = 0; k < 4; ++k) map.insertScan(street()[k].points, street()[k].pose);
  std::size_t road = 0, ground = 0;
  octomap::Pointcloud world(street()[3].points);
  world.transform(street()[3].pose);
  for (unsigned i = 0; i < world.size(); ++i) {
    if ((street()[3].labels[i] & 0xffffU) != sim::kRoad || street()[3].points[i].norm() > 15 ||
        street()[3].points[i].norm() < 3)
      continue;
    OcTreeKey key;
    ASSERT_TRUE(map.coordToKeyChecked(world[i], key));
    ++road;
    ground += map.isGround(key);
  }
  EXPECT_GT(road, 1000U);
  EXPECT_GT(static_cast<double>(ground), 0.97 * static_cast<double>(road));
}

TEST(RhMap, LosesABoxThatCrossesAYard) {
  const std::vector<Scan> scans = test::yard(32, true);
  RhMap map(0.1);
  insertAll(map, scans);
  const auto [kept, gone] = score(map, scans);
  EXPECT_GT(kept, 0.99);
  EXPECT_GT(gone, 0.95);
}

TEST(RhMap, KeepsAYardThatNobodyCrosses) {
  const std::vector<Scan> scans = test::yard(32, false);
  for (const std::string_view profile : {"fast", "default"}) {
    RhMap map(0.1, removalProfile(profile));
    insertAll(map, scans);
    EXPECT_GT(score(map, scans).first, 0.995) << profile;
  }
}

TEST(RhMap, RemovesDynamicThingsAlsoAfterAFirstScanOfNearlyNothing) {
  octomap::Pointcloud first;
  for (int i = 0; i < 5; ++i) first.push_back(10, static_cast<float>(i), 0.01F * static_cast<float>(i));
  const std::vector<Scan> scans = test::yard(32, true);
  RhMap map(0.1);
  map.insertScan(first, octomap::pose6d());
  insertAll(map, scans);
  EXPECT_GT(score(map, scans).second, 0.9);
}

}  // namespace
}  // namespace rhmap
