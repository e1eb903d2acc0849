// SPDX-License-Identifier: BSD-3-Clause
// Numbers of nodes after each step of pruning, expanding and deleting; addresses of leaves.
#include <gtest/gtest.h>
#include <octomap/octomap.h>

namespace {

using octomap::OcTree;
using octomap::OcTreeKey;
using octomap::OcTreeNode;
using octomap::point3d;

void expectSizes(const OcTree& tree, std::size_t nodes, std::size_t leaves) {
  EXPECT_EQ(tree.size(), nodes);
  EXPECT_EQ(tree.calcNumNodes(), nodes);
  EXPECT_EQ(tree.getNumLeafNodes(), leaves);
}

/// Updates the cells of a cube of keys with this corner.
void updateCube(OcTree& tree, const OcTreeKey& corner, unsigned edge, bool occupied) {
  for (unsigned i = 0; i < edge * edge * edge; ++i) {
    tree.updateNode(OcTreeKey(octomap::key_type(corner[0] + i % edge), octomap::key_type(corner[1] + i / edge % edge),
                              octomap::key_type(corner[2] + i / edge / edge)),
                    occupied);
  }
}

TEST(Structure, AnEmptyTreeHasNothingToDo) {
  OcTree tree(0.05);
  expectSizes(tree, 0, 0);
  tree.prune();
  tree.expand();
  tree.clear();
  tree.updateInnerOccupancy();
  expectSizes(tree, 0, 0);
  EXPECT_EQ(tree.getRoot(), nullptr);
  EXPECT_EQ(tree.search(0, 0, 0), nullptr);
}

TEST(Structure, ACellIsABranch) {
  OcTree tree(0.05);
  const OcTreeNode* cell = tree.updateNode(point3d(0.01F, 0.01F, 0.01F), true);
  expectSizes(tree, 17, 1);
  tree.prune();
  tree.expand();
  expectSizes(tree, 17, 1);
  EXPECT_EQ(tree.search(point3d(0.01F, 0.01F, 0.01F)), cell);
  // A cell on the other side of all three axes shares the root alone.
  tree.updateNode(point3d(-0.01F, -0.01F, -0.01F), true);
  expectSizes(tree, 33, 2);
}

TEST(Structure, EightEqualCellsBecomeTheirParentAtTheLastUpdate) {
  OcTree tree(0.05);
  const OcTreeKey corner(32768, 32768, 32768);
  OcTreeNode* last = nullptr;
  for (unsigned i = 0; i < 8; ++i) {
    const OcTreeKey key(octomap::key_type(corner[0] + (i & 1)), octomap::key_type(corner[1] + (i >> 1 & 1)),
                        octomap::key_type(corner[2] + (i >> 2)));
    last = tree.updateNode(key, true);
    if (i < 7) expectSizes(tree, 17 + i, i + 1);
  }
  expectSizes(tree, 16, 1);
  EXPECT_EQ(tree.search(corner), last);
  EXPECT_EQ(last->getLogOdds(), tree.getProbHitLog());
  EXPECT_FALSE(tree.nodeHasChildren(last));

  // An update inside brings the eight back: one with a new value, seven with the old one.
  OcTreeNode* cell = tree.updateNode(corner, false);
  expectSizes(tree, 24, 8);
  EXPECT_EQ(cell->getLogOdds(), tree.getProbHitLog() + tree.getProbMissLog());
  const OcTreeNode* sibling = tree.search(OcTreeKey(32769, 32768, 32768));
  EXPECT_EQ(sibling->getLogOdds(), tree.getProbHitLog());
  EXPECT_EQ(tree.search(corner, 15)->getLogOdds(), tree.getProbHitLog());
}

TEST(Structure, LazyUpdatesLeaveThePruningToTheCaller) {
  OcTree tree(0.05);
  for (unsigned i = 0; i < 64; ++i)
    tree.updateNode(
        OcTreeKey(octomap::key_type(4 + i % 4), octomap::key_type(8 + i / 4 % 4), octomap::key_type(12 + i / 16)), true,
        true);
  expectSizes(tree, 15 + 8 + 64, 64);
  EXPECT_EQ(tree.getRoot()->getLogOdds(), 0.0F);
  tree.updateInnerOccupancy();
  EXPECT_EQ(tree.getRoot()->getLogOdds(), tree.getProbHitLog());
  expectSizes(tree, 87, 64);
  tree.prune();
  expectSizes(tree, 15, 1);
  tree.expand();
  expectSizes(tree, 87, 64);
}

TEST(Structure, ALargeCubeIsPrunedExpandedAndHollowedOut) {
  OcTree tree(0.1);
  const OcTreeKey corner(32768, 32768, 32768);
  updateCube(tree, corner, 16, true);
  expectSizes(tree, 13, 1);
  const OcTree pruned(tree);

  tree.expand();
  expectSizes(tree, 13 + 8 + 64 + 512 + 4096, 4096);
  tree.prune();
  expectSizes(tree, 13, 1);
  EXPECT_TRUE(tree == pruned);

  tree.deleteNode(corner);
  expectSizes(tree, 13 + 4 * 8 - 1, 4 * 7);
  tree.updateNode(corner, true);
  expectSizes(tree, 13, 1);
  EXPECT_TRUE(tree == pruned);

  tree.updateNode(OcTreeKey(32776, 32776, 32776), false);  // in the middle
  expectSizes(tree, 13 + 4 * 8, 4 * 7 + 1);
  tree.toMaxLikelihood();
  tree.prune();
  expectSizes(tree, 13, 1);
}

TEST(Structure, NeighboursOfDifferentKindDoNotMelt) {
  OcTree tree(0.1);
  updateCube(tree, OcTreeKey(32768, 32768, 32768), 4, true);
  updateCube(tree, OcTreeKey(32772, 32768, 32768), 4, false);
  expectSizes(tree, 16, 2);
  EXPECT_TRUE(tree.isNodeOccupied(tree.search(OcTreeKey(32771, 32771, 32771))));
  EXPECT_FALSE(tree.isNodeOccupied(tree.search(OcTreeKey(32772, 32771, 32771))));
  EXPECT_TRUE(tree.isNodeOccupied(tree.search(OcTreeKey(32768, 32768, 32768), 13)));
}

TEST(Structure, NodesAreMadePrunedAndExpandedByPointer) {
  OcTree tree(0.1);
  tree.updateNode(OcTreeKey(40000, 40000, 40000), true);
  OcTreeNode* above = tree.search(OcTreeKey(40000, 40000, 40000), 15);
  ASSERT_TRUE(tree.nodeHasChildren(above));
  EXPECT_FALSE(tree.isNodeCollapsible(above));
  EXPECT_FALSE(tree.pruneNode(above));
  for (unsigned i = 0; i < 8; ++i)
    if (!tree.nodeChildExists(above, i)) tree.createNodeChild(above, i)->setValue(tree.getProbHitLog());
  expectSizes(tree, 24, 8);
  EXPECT_TRUE(tree.isNodeCollapsible(above));
  EXPECT_TRUE(tree.pruneNode(above));
  expectSizes(tree, 16, 1);
  tree.expandNode(above);
  expectSizes(tree, 24, 8);
  tree.deleteNodeChild(above, 3);
  expectSizes(tree, 23, 7);
  EXPECT_FALSE(tree.nodeChildExists(above, 3));
}

TEST(Structure, LeavesStayWhereTheyAre) {
  OcTree tree(0.1);
  const OcTreeKey key(32768, 32768, 32768);
  const OcTreeNode* leaf = tree.updateNode(key, true);
  const OcTreeNode* above = tree.search(key, 12);
  for (int i = 0; i < 20000; ++i)
    tree.updateNode(OcTreeKey(octomap::key_type(32600 + i * 7919 % 331), octomap::key_type(32600 + i * 104729 % 313),
                              octomap::key_type(32770 + i % 97)),
                    i % 3 == 0);
  EXPECT_EQ(tree.search(key), leaf);
  EXPECT_EQ(tree.search(key, 12), above);
  EXPECT_EQ(leaf->getLogOdds(), tree.getProbHitLog());
}

#ifdef RHMAP_COMPAT_OCTOMAP  // the installed OctoMap stops in an assert
TEST(Structure, DeletingTakesEmptyAncestorsAlong) {
  OcTree tree(0.1);
  const OcTreeKey a(32768, 32768, 32768), b(32770, 32768, 32768);
  tree.updateNode(a, true);
  tree.updateNode(b, true);
  expectSizes(tree, 19, 2);
  EXPECT_FALSE(tree.deleteNode(b));
  expectSizes(tree, 17, 1);
  EXPECT_EQ(tree.search(b), nullptr);
  EXPECT_FALSE(tree.deleteNode(b));
  expectSizes(tree, 17, 1);
}
#endif

}  // namespace
