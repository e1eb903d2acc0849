// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/removal/rh_map.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "street.hpp"

namespace rhmap {
namespace {

using test::bytes;
using test::insertAll;
using test::Scan;
using test::street;

TEST(RhMap, IsWrittenAndReadLikeAnyOther) {
  RhMap map(0.1);
  insertAll(map, std::vector<Scan>(street().begin(), street().begin() + 10));
  std::stringstream file;
  map.write(file);
  const std::unique_ptr<AbstractOcTree> read(AbstractOcTree::read(file));
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(bytes(dynamic_cast<OcTree&>(*read)), bytes(map));
}

TEST(RhMap, SurvivesBadScans) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  octomap::Pointcloud bad;
  for (const float v : {kNan, kInf, -kInf, 1e30F, -1e30F, 0.0F}) bad.push_back(v, 10, 1);
  RhMap map(0.1);
  const ScanReport report = map.insertScan(bad, octomap::pose6d());
  EXPECT_EQ(report.points, 6U);
  EXPECT_EQ(report.dropped, 5U);
  map.insertScan(octomap::Pointcloud(), octomap::pose6d());
  map.insertScan(street()[0].points, octomap::pose6d(1e9F, 0, 0, 0, 0, 0));
  map.insertScan(street()[0].points, octomap::pose6d(kNan, 0, 0, 0, 0, 0));
  map.insertScan(street()[0].points, octomap::pose6d(3270, 3270, 0, 0, 0, 0));  // at the border of the keys
  map.removeDynamic(bad, octomap::pose6d());
  EXPECT_GT(map.insertScan(street()[0].points, street()[0].pose).inserted, 1000U);
  map.finish();
}

TEST(RhMap, IsTheSameWithChangeDetection) {
  for (const bool carve : {false, true}) {
    RemovalConfig config;
    config.carve = carve;
    RhMap map(0.2, config), watched(0.2, config);
    watched.enableChangeDetection(true);
    for (std::size_t k = 0; k < 5; ++k) {
      const ScanReport report = watched.insertScan(street()[k].points, street()[k].pose);
      if (k == 0 && !carve) {
        EXPECT_EQ(watched.numChangesDetected(), report.inserted);
      }
      map.insertScan(street()[k].points, street()[k].pose);
    }
    EXPECT_TRUE(bytes(watched) == bytes(map)) << carve;
  }
}

TEST(RhMap, ACopyGoesItsOwnWay) {
  RhMap map(0.1);
  map.insertScan(street()[0].points, street()[0].pose);
  RhMap copy(map);
  const std::string before = bytes(copy);
  map.insertScan(street()[1].points, street()[1].pose);
  EXPECT_EQ(bytes(copy), before);
  copy.insertScan(street()[1].points, street()[1].pose);
  EXPECT_GT(copy.size(), 0U);
}

TEST(RhMap, RefusesAWrongConfiguration) {
  RemovalConfig config;
  config.region_size = 7;
  EXPECT_THROW(RhMap(0.1, config), std::invalid_argument);
}

TEST(RhMap, CountsTheScansOfASensorOutsideOfTheTreeAsDropped) {
  RhMap map(0.1);
  octomap::Pointcloud back;
  back.push_back(-10, 0, 0);
  const ScanReport report = map.insertScan(back, octomap::pose6d(3280, 0, 0, 0, 0, 0));
  EXPECT_EQ(report.points, 1U);
  EXPECT_EQ(report.dropped, 1U);
  EXPECT_EQ(map.size(), 0U);
}

/// Inner nodes are as their children's largest, none is without children, and each leaf is found by its key.
TEST(RhMap, IsAValidTreeAfterRemovals) {
  for (const bool carve : {false, true}) {
    RemovalConfig config = fastProfile();
    config.carve = carve;
    RhMap map(0.2, config);
    std::size_t removed = 0, nodes = 0;
    for (std::size_t k = 0; k < 14; ++k) removed += map.insertScan(street()[k].points, street()[k].pose).removed;
    EXPECT_GT(removed, 20U);
    for (auto it = map.begin_tree(), end = map.end_tree(); it != end; ++it) {
      ++nodes;
      const OcTreeNode* node = &*it;
      const unsigned depth = it.getDepth();
      ASSERT_EQ(depth == 0 ? map.getRoot() : map.search(it.getKey(), depth), node);  // 0 would be the finest
      if (it.isLeaf()) continue;
      ASSERT_TRUE(map.nodeHasChildren(node));
      ASSERT_EQ(node->getLogOdds(), node->getMaxChildLogOdds());
    }
    EXPECT_EQ(nodes, map.size());
    EXPECT_EQ(nodes, map.calcNumNodes());
  }
}

TEST(RhMap, StartsAnewWhenCleared) {
  RhMap fresh(0.1), cleared(0.1);
  for (std::size_t k = 0; k < 8; ++k) cleared.insertScan(street()[k].points, street()[k].pose);
  cleared.clear();
  EXPECT_FALSE(cleared.isGround(OcTreeKey(kTreeMaxVal + 50, kTreeMaxVal, kTreeMaxVal - 18)));
  for (std::size_t k = 0; k < 8; ++k) {
    const ScanReport expected = fresh.insertScan(street()[k].points, street()[k].pose);
    const ScanReport report = cleared.insertScan(street()[k].points, street()[k].pose);
    ASSERT_EQ(report.inserted, expected.inserted) << k;
    ASSERT_EQ(report.removed, expected.removed) << k;
  }
  EXPECT_TRUE(bytes(cleared) == bytes(fresh));
}

TEST(RhMap, TakesTheResolutionOfTheFileThatItReads) {
  OcTree coarse(0.4);
  coarse.updateNode(octomap::point3d(1, 2, 3), true);
  std::stringstream file;
  coarse.writeBinary(file);
  RhMap expected(0.4), map(0.1);
  expected.updateNode(octomap::point3d(1, 2, 3), true);
  expected.toMaxLikelihood();
  ASSERT_TRUE(map.readBinary(file));
  EXPECT_EQ(map.getResolution(), 0.4);
  for (std::size_t k = 0; k < 10; ++k) {
    const ScanReport a = expected.insertScan(street()[k].points, street()[k].pose);
    const ScanReport b = map.insertScan(street()[k].points, street()[k].pose);
    ASSERT_EQ(a.inserted, b.inserted);
    ASSERT_EQ(a.removed, b.removed);
  }
  EXPECT_TRUE(bytes(map) == bytes(expected));
}

}  // namespace
}  // namespace rhmap
