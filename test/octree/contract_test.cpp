// SPDX-License-Identifier: BSD-3-Clause
// OctoMap's corner cases, one text for both trees: what holds here for stock OctoMap holds for rhmap.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <sstream>
#include <vector>

#include "oracle.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {
namespace {

template <class Tree>
class Contract : public testing::Test {
 protected:
  Tree map{0.1};
  const OcTreeKey key{32770, 32771, 32772};

  /// Eight equal cells under one depth-15 node.
  void fillCube() {
    for (int i = 0; i < 8; ++i)
      map.updateNode(OcTreeKey(static_cast<key_type>(32770 + (i & 1)), static_cast<key_type>(32772 + (i >> 1 & 1)),
                               static_cast<key_type>(32774 + (i >> 2))),
                     true);
  }
};
using Trees = testing::Types<OcTree, test::OctomapOracle>;
TYPED_TEST_SUITE(Contract, Trees);

TYPED_TEST(Contract, DefaultsAreOctomapsFloats) {
  EXPECT_EQ(this->map.getProbHitLog(), 0x1.b1d106p-1F);
  EXPECT_EQ(this->map.getProbMissLog(), -0x1.9f323ep-2F);
  EXPECT_EQ(this->map.getClampingThresMinLog(), -0x1.0000eap+1F);
  EXPECT_EQ(this->map.getClampingThresMaxLog(), 0x1.c16974p+1F);
  EXPECT_EQ(this->map.getOccupancyThresLog(), 0.0F);
  EXPECT_NEAR(this->map.getProbHit(), 0.7, 1e-7);
  EXPECT_EQ(this->map.getTreeType(), "OcTree");
  EXPECT_EQ(this->map.getTreeDepth(), 16U);
}

TYPED_TEST(Contract, OneCellMakesSeventeenNodes) {
  EXPECT_EQ(this->map.size(), 0U);
  EXPECT_EQ(this->map.getRoot(), nullptr);
  auto* node = this->map.updateNode(this->key, true);
  EXPECT_EQ(this->map.size(), 17U);
  EXPECT_EQ(this->map.search(this->key), node);
  EXPECT_EQ(node->getLogOdds(), this->map.getProbHitLog());
  EXPECT_EQ(this->map.search(this->key, 16), node);
  EXPECT_EQ(this->map.search(OcTreeKey(0, 0, 0)), nullptr);
  EXPECT_EQ(this->map.search(OcTreeKey(32771, 32771, 32772)), nullptr);
}

TYPED_TEST(Contract, AnUpdateByZeroStillMakesTheCell) {
  this->map.updateNode(this->key, 0.0F);
  ASSERT_NE(this->map.search(this->key), nullptr);
  EXPECT_EQ(this->map.search(this->key)->getLogOdds(), 0.0F);
  EXPECT_TRUE(this->map.isNodeOccupied(this->map.search(this->key)));
}

TYPED_TEST(Contract, EightEqualCellsBecomeOneLeaf) {
  this->fillCube();
  EXPECT_EQ(this->map.size(), 16U);
  auto* leaf = this->map.search(OcTreeKey(32770, 32772, 32774));
  EXPECT_EQ(leaf, this->map.search(OcTreeKey(32771, 32773, 32775)));
  EXPECT_EQ(leaf, this->map.search(OcTreeKey(32771, 32773, 32775), 15));
  EXPECT_FALSE(this->map.nodeHasChildren(leaf));
  auto it = this->map.begin();
  EXPECT_EQ(it.getDepth(), 15U);
  EXPECT_EQ(it.getKey(), OcTreeKey(32771, 32773, 32775));
  EXPECT_EQ(it.getIndexKey(), OcTreeKey(32770, 32772, 32774));
  EXPECT_DOUBLE_EQ(it.getSize(), 0.2);
}

TYPED_TEST(Contract, AnUpdateInAPrunedLeafExpandsItUnlessTheLeafIsAtItsClamp) {
  this->fillCube();
  this->map.updateNode(OcTreeKey(32770, 32772, 32774), true);
  EXPECT_EQ(this->map.size(), 24U);
  for (int i = 0; i < 5; ++i) this->fillCube();
  EXPECT_EQ(this->map.size(), 16U);
  auto* leaf = this->map.search(OcTreeKey(32770, 32772, 32774));
  EXPECT_EQ(leaf->getLogOdds(), this->map.getClampingThresMaxLog());
  EXPECT_EQ(this->map.updateNode(OcTreeKey(32770, 32772, 32774), true), leaf);
  EXPECT_EQ(this->map.size(), 16U);
}

TYPED_TEST(Contract, ThePrunedParentIsWhatAnUpdateReturns) {
  for (int i = 0; i < 7; ++i)
    this->map.updateNode(OcTreeKey(static_cast<key_type>(32770 + (i & 1)), static_cast<key_type>(32772 + (i >> 1 & 1)),
                                   static_cast<key_type>(32774 + (i >> 2))),
                         true);
  auto* parent = this->map.search(OcTreeKey(32771, 32773, 32775), 15);
  EXPECT_EQ(this->map.updateNode(OcTreeKey(32771, 32773, 32775), true), parent);
  EXPECT_FALSE(this->map.nodeHasChildren(parent));
}

TYPED_TEST(Contract, AddressesStayWhileOtherCellsComeAndGo) {
  auto* node = this->map.updateNode(this->key, true);
  auto* root = this->map.getRoot();
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 40; ++y)
      this->map.updateNode(OcTreeKey(static_cast<key_type>(33000 + x), static_cast<key_type>(32000 + y), 32768), false);
  for (int x = 0; x < 20; ++x) this->map.deleteNode(OcTreeKey(static_cast<key_type>(33000 + x), 32000, 32768));
  this->map.prune();
  EXPECT_EQ(this->map.search(this->key), node);
  EXPECT_EQ(this->map.getRoot(), root);
  EXPECT_EQ(node->getLogOdds(), this->map.getProbHitLog());
}

TYPED_TEST(Contract, EveryNodeCanBeReachedByPointerFromTheRoot) {
  this->fillCube();
  this->map.updateNode(this->key, false);
  this->map.updateNode(OcTreeKey(1, 65535, 9), true);
  std::size_t nodes = 0;
  const auto visit = [&](auto&& self, auto* node) -> void {
    ++nodes;
    for (unsigned i = 0; i < 8; ++i)
      if (this->map.nodeChildExists(node, i)) self(self, this->map.getNodeChild(node, i));
  };
  visit(visit, this->map.getRoot());
  EXPECT_EQ(nodes, this->map.size());
}

TYPED_TEST(Contract, InnerNodesAreNeverBelowTheirChildren) {
  this->map.updateNode(this->key, true);
  this->map.updateNode(OcTreeKey(32771, 32771, 32772), false);
  for (unsigned depth = 1; depth < 16; ++depth)
    EXPECT_EQ(this->map.search(this->key, depth)->getLogOdds(), this->map.getProbHitLog());
  EXPECT_EQ(this->map.getRoot()->getLogOdds(), this->map.getProbHitLog());
}

TYPED_TEST(Contract, LazyUpdatesLeaveInnerNodesAlone) {
  this->map.updateNode(this->key, true, true);
  EXPECT_EQ(this->map.getRoot()->getLogOdds(), 0.0F);
  this->map.updateInnerOccupancy();
  EXPECT_EQ(this->map.getRoot()->getLogOdds(), this->map.getProbHitLog());
}

TYPED_TEST(Contract, SetNodeValueClampsMinusInfinityAndKeepsNan) {
  this->map.setNodeValue(this->key, -std::numeric_limits<float>::infinity());
  EXPECT_EQ(this->map.search(this->key)->getLogOdds(), this->map.getClampingThresMinLog());
  const OcTreeKey other(32770, 32771, 32773);
  this->map.setNodeValue(other, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(std::isnan(this->map.search(other)->getLogOdds()));
}

TYPED_TEST(Contract, ANewClampingDoesNotTouchWhatIsThere) {
  for (int i = 0; i < 10; ++i) this->map.updateNode(this->key, true);
  this->map.setClampingThresMax(0.7);
  EXPECT_EQ(this->map.search(this->key)->getLogOdds(), 0x1.c16974p+1F);
}

TYPED_TEST(Contract, DeletingTheLastCellLeavesTheRoot) {
  EXPECT_TRUE(this->map.deleteNode(this->key));  // OctoMap: nothing there, nothing left
  this->map.updateNode(this->key, true);
  this->map.updateNode(OcTreeKey(1, 2, 3), true);
  EXPECT_FALSE(this->map.deleteNode(OcTreeKey(32770, 32770, 32770)));
  EXPECT_FALSE(this->map.deleteNode(this->key));
  EXPECT_EQ(this->map.size(), 17U);
  EXPECT_TRUE(this->map.deleteNode(OcTreeKey(1, 2, 3)));
  EXPECT_EQ(this->map.size(), 1U);
  EXPECT_NE(this->map.search(this->key), nullptr);  // the root answers for everything
  this->map.updateNode(this->key, true);
  EXPECT_EQ(this->map.size(), 129U);
}

TYPED_TEST(Contract, PruneStopsAtTheFirstLevelWhereNothingCollapsed) {
  // 4 x 4 x 4 cells as eight cubes with values of their own: made equal, they could collapse at depth 14.
  for (int i = 0; i < 64; ++i) {
    const OcTreeKey cell(static_cast<key_type>(32768 + i % 4), static_cast<key_type>(32768 + i / 4 % 4),
                         static_cast<key_type>(32768 + i / 16));
    this->map.setNodeValue(cell, 0.1F + 0.1F * static_cast<float>(i % 4 / 2 + 2 * (i / 4 % 4 / 2) + 4 * (i / 16 / 2)));
  }
  EXPECT_EQ(this->map.getNumLeafNodes(), 8U);
  this->map.toMaxLikelihood();
  this->map.prune();
  EXPECT_EQ(this->map.getNumLeafNodes(), 8U);
  for (int i = 0; i < 8; ++i)  // one collapsible node at depth 15 elsewhere
    this->map.setNodeValue(
        OcTreeKey(static_cast<key_type>(40000 + (i & 1)), static_cast<key_type>(40000 + (i >> 1 & 1)),
                  static_cast<key_type>(40000 + (i >> 2))),
        3.0F, true);
  this->map.toMaxLikelihood();
  this->map.prune();
  EXPECT_EQ(this->map.getNumLeafNodes(), 2U);
}

TYPED_TEST(Contract, ZeroMaxRangeInsertsNothingInACloudAndMeansNoLimitInARay) {
  octomap::Pointcloud scan;
  scan.push_back(1, 1, 1);
  this->map.insertPointCloud(scan, point3d(0, 0, 0), 0.0);
  EXPECT_EQ(this->map.size(), 0U);
  EXPECT_TRUE(this->map.insertRay(point3d(0, 0, 0), point3d(1, 1, 1), 0.0));
  EXPECT_TRUE(this->map.isNodeOccupied(this->map.search(1, 1, 1)));
}

TYPED_TEST(Contract, CastRayTellsWhyItStopped) {
  this->map.insertRay(point3d(0.05F, 0.05F, 0.05F), point3d(2.05F, 0.05F, 0.05F));
  point3d end(9, 9, 9);
  EXPECT_TRUE(this->map.castRay(point3d(0.05F, 0.05F, 0.05F), point3d(1, 0, 0), end));
  EXPECT_EQ(end, this->map.keyToCoord(this->map.coordToKey(2.05, 0.05, 0.05)));
  EXPECT_FALSE(this->map.castRay(point3d(0.05F, 0.05F, 0.05F), point3d(1, 0, 0), end, false, 1.0));
  EXPECT_NEAR(end.x(), 1.15, 1e-6);  // the first centre beyond the range
  EXPECT_FALSE(this->map.castRay(point3d(0.05F, 0.05F, 0.05F), point3d(0, 1, 0), end));
  EXPECT_NEAR(end.y(), 0.15, 1e-6);  // unknown
  EXPECT_FALSE(this->map.castRay(point3d(0.05F, 0.05F, 0.05F), point3d(0, 1, 0), end, true));
  EXPECT_NEAR(end.y(), 3276.75, 1e-3);  // the border of the key space
  end = point3d(9, 9, 9);
  EXPECT_FALSE(this->map.castRay(point3d(0.05F, 0.05F, 0.05F), point3d(0, 0, 0), end));
  EXPECT_FALSE(this->map.castRay(point3d(1e6F, 0, 0), point3d(1, 0, 0), end));
  EXPECT_EQ(end, point3d(9, 9, 9));
}

TYPED_TEST(Contract, EmptyMapsIterateOverNothing) {
  EXPECT_TRUE(this->map.begin() == this->map.end());
  EXPECT_TRUE(this->map.begin_tree() == this->map.end_tree());
  EXPECT_TRUE(this->map.begin_leafs_bbx(point3d(-1, -1, -1), point3d(1, 1, 1)) == this->map.end_leafs_bbx());
  double x = 1, y = 1, z = 1;
  this->map.getMetricMin(x, y, z);
  EXPECT_EQ(x + y + z, 0.0);
  this->map.prune();
  this->map.expand();
  this->map.updateInnerOccupancy();
  this->map.toMaxLikelihood();
  EXPECT_EQ(this->map.size(), 0U);
  EXPECT_EQ(this->map.memoryFullGrid(), 0U);
}

TYPED_TEST(Contract, BoxIterationTakesALeafThatEndsOneCellBelowTheBox) {
  this->fillCube();
  const OcTreeKey below(32772, 32774, 32776), further(32773, 32775, 32777), high(40000, 40000, 40000);
  EXPECT_FALSE(this->map.begin_leafs_bbx(below, high) == this->map.end_leafs_bbx());
  EXPECT_TRUE(this->map.begin_leafs_bbx(further, high) == this->map.end_leafs_bbx());
}

TYPED_TEST(Contract, ARootWithoutChildrenIsReadBackAsOccupiedSpace) {
  this->map.updateNode(this->key, false);
  this->map.deleteNode(this->key);
  std::stringstream file(test::btBytes(this->map));
  ASSERT_TRUE(this->map.readBinary(file));
  EXPECT_EQ(this->map.size(), 1U);
  EXPECT_TRUE(this->map.isNodeOccupied(this->map.getRoot()));
}

TYPED_TEST(Contract, ReadBinaryTakesTheResolutionAndKeepsTheSensorModel) {
  this->map.updateNode(this->key, true);
  std::stringstream file(test::btBytes(this->map));
  TypeParam other(0.7);
  other.setClampingThresMax(0.9);
  ASSERT_TRUE(other.readBinary(file));
  EXPECT_EQ(other.getResolution(), 0.1);
  EXPECT_EQ(other.search(this->key)->getLogOdds(), other.getClampingThresMaxLog());
}

TYPED_TEST(Contract, EqualityIncludesInnerValuesAndResolution) {
  TypeParam other(0.1);
  this->map.updateNode(this->key, true);
  other.updateNode(this->key, true);
  EXPECT_TRUE(this->map == other);
  other.getRoot()->setLogOdds(1.5F);
  EXPECT_FALSE(this->map == other);
  other.updateInnerOccupancy();
  EXPECT_TRUE(this->map == other);
  other.setResolution(0.2);
  EXPECT_FALSE(this->map == other);
}

TYPED_TEST(Contract, ChangesAreRememberedUntilTheyAreUndone) {
  this->map.enableChangeDetection(true);
  this->map.updateNode(this->key, false);
  EXPECT_EQ(this->map.numChangesDetected(), 1U);
  EXPECT_TRUE(this->map.changedKeysBegin()->second);
  this->map.updateNode(this->key, true);
  this->map.updateNode(this->key, false);
  EXPECT_TRUE(this->map.changedKeysBegin()->second);
  this->map.resetChangeDetection();
  this->map.setNodeValue(this->key, 2.0F);
  this->map.resetChangeDetection();
  this->map.setNodeValue(this->key, -1.0F);
  ASSERT_EQ(this->map.numChangesDetected(), 1U);
  EXPECT_FALSE(this->map.changedKeysBegin()->second);
  this->map.setNodeValue(this->key, 1.0F);
  EXPECT_EQ(this->map.numChangesDetected(), 0U);
}

// --- where rhmap differs, on purpose (doc/octomap-differences.md) ---

TEST(Difference, DeletingAnInnerNodeDeletesWhatIsBelowAndCountsIt) {
  OcTree map(0.1);
  for (int i = 0; i < 4; ++i) map.updateNode(OcTreeKey(static_cast<key_type>(32768 + i), 32768, 32768), i % 2 == 0);
  map.updateNode(OcTreeKey(1, 1, 1), true);
  map.deleteNode(OcTreeKey(32768, 32768, 32768), 14);
  EXPECT_EQ(map.size(), 17U);
  std::size_t nodes = 0;
  for (auto it = map.begin_tree(); it != map.end_tree(); ++it) ++nodes;
  EXPECT_EQ(nodes, 17U);
}

TEST(Difference, EditsByPointerThatMakeNoSenseChangeNothing) {
  OcTree map(0.1);
  OcTreeNode* cell = map.updateNode(OcTreeKey(32768, 32768, 32768), true);
  OcTreeNode* parent = map.search(OcTreeKey(32768, 32768, 32768), 15);
  OcTreeNode* coarse = map.search(OcTreeKey(32768, 32768, 32768), 13);
  const std::string before = test::otBytes(map);
  EXPECT_EQ(map.createNodeChild(cell, 0), nullptr);
  EXPECT_EQ(map.createNodeChild(parent, 0), cell);
  map.deleteNodeChild(cell, 0);
  map.deleteNodeChild(parent, 5);
  for (OcTreeNode* node : {cell, parent, coarse, map.getRoot()}) {
    map.expandNode(node);
    EXPECT_FALSE(map.pruneNode(node));
  }
  EXPECT_TRUE(test::otBytes(map) == before);
}

TEST(Difference, BoundsFollowTheNodesThroughSwapContent) {
  OcTree a(0.1), b(0.1);
  a.updateNode(1.0, 1.0, 1.0, true);
  double x, y, z;
  a.getMetricMax(x, y, z);
  a.swapContent(b);
  a.getMetricMax(x, y, z);
  EXPECT_EQ(x, 0.0);
  b.getMetricMax(x, y, z);
  EXPECT_GT(x, 1.0);
}

TEST(Difference, ABoxWithACornerOutsideOfTheTreeHoldsNothing) {
  OcTree map(0.1);
  map.updateNode(1.0, 1.0, 1.0, true);
  EXPECT_TRUE(map.begin_leafs_bbx(point3d(-1e6F, 0, 0), point3d(2, 2, 2)) == map.end_leafs_bbx());
}

TEST(InnerValues, OfAnyChildrenAreOctomaps) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity(), kLeast = std::numeric_limits<float>::lowest();
  const std::vector<float> odd{0.0F, -0.0F, NAN, -NAN, kInfinity, -kInfinity, kLeast, 1.5F, -1.5F};
  std::mt19937 random(12);
  std::set<std::uint32_t> results;
  for (int round = 0; round < 3000; ++round) {
    OcTree ours(0.1);
    test::OctomapOracle theirs(0.1);
    const auto which = static_cast<unsigned>(random() % 255 + 1);
    for (unsigned i = 0; i < 8; ++i) {
      if ((which >> i & 1) == 0) continue;
      const OcTreeKey key(static_cast<key_type>(32770 + (i & 1)), static_cast<key_type>(32772 + (i >> 1 & 1)),
                          static_cast<key_type>(32774 + (i >> 2)));
      const float value = odd[random() % (round % 2 == 0 ? odd.size() : 4)];
      ours.updateNode(key, true, true)->setLogOdds(value);
      theirs.updateNode(key, true, true)->setLogOdds(value);
    }
    ours.updateInnerOccupancy();
    theirs.updateInnerOccupancy();
    const OcTreeKey key(32770, 32772, 32774);
    const auto bits = [&](auto& tree) { return std::bit_cast<std::uint32_t>(tree.search(key, 15)->getLogOdds()); };
    ASSERT_EQ(bits(ours), bits(theirs)) << which << ", round " << round;
    results.insert(bits(ours));
  }
  EXPECT_GE(results.size(), 6U);
}

TEST(Difference, MemoryUsageIsWhatTheMapHolds) {
  OcTree map(0.1);
  const std::size_t empty = map.memoryUsage();
  EXPECT_LT(empty, 4096U);
  map.updateNode(1.0, 1.0, 1.0, true);
  EXPECT_GT(map.memoryUsage(), empty + 2 * sizeof(Block));
  map.clear();
  EXPECT_EQ(map.memoryUsage(), empty);
}

}  // namespace
}  // namespace rhmap
