// SPDX-License-Identifier: BSD-3-Clause
// Trees with colours and with time stamps.
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTreeStamped.h>

#include <memory>
#include <sstream>

namespace {

using octomap::AbstractOcTree;
using octomap::ColorOcTree;
using octomap::ColorOcTreeNode;
using octomap::OcTreeKey;
using octomap::OcTreeNodeStamped;
using octomap::OcTreeStamped;
using octomap::point3d;

OcTreeKey cell(unsigned i) {
  return OcTreeKey(octomap::key_type(32768 + (i & 1)), octomap::key_type(32768 + (i >> 1 & 1)),
                   octomap::key_type(32768 + (i >> 2)));
}

/// Eight siblings with red 0, 10 ... 70.
ColorOcTree eightColours(bool lazy) {
  ColorOcTree tree(0.1);
  for (unsigned i = 0; i < 8; ++i) {
    tree.updateNode(cell(i), true, true);
    tree.setNodeColor(cell(i), static_cast<std::uint8_t>(10 * i), 100, 200);
  }
  if (!lazy) {
    tree.updateInnerOccupancy();
    tree.prune();
  }
  return tree;
}

TEST(Colour, IsAveragedWhenEqualLeavesMelt) {
  ColorOcTree tree = eightColours(false);
  EXPECT_EQ(tree.size(), 16U);
  const ColorOcTreeNode* melted = tree.search(cell(5));
  EXPECT_FALSE(tree.nodeHasChildren(melted));
  EXPECT_EQ(melted->getColor(), ColorOcTreeNode::Color(35, 100, 200));

  tree.updateNode(cell(5), false);
  EXPECT_EQ(tree.size(), 24U);
  EXPECT_EQ(tree.search(cell(2))->getColor(), ColorOcTreeNode::Color(35, 100, 200));
}

TEST(Colour, OfInnerNodesIsTheMeanOfThoseThatHaveOne) {
  ColorOcTree tree = eightColours(true);
  tree.search(cell(7))->setColor(255, 255, 255);
  EXPECT_FALSE(tree.search(cell(7))->isColorSet());
  EXPECT_FALSE(tree.getRoot()->isColorSet());
  tree.updateInnerOccupancy();
  EXPECT_EQ(tree.getRoot()->getColor(), ColorOcTreeNode::Color(30, 100, 200));
  EXPECT_EQ(tree.size(), 24U);
}

TEST(Colour, IsSetAveragedAndIntegrated) {
  ColorOcTree tree(0.1);
  EXPECT_EQ(tree.setNodeColor(1, 1, 1, 10, 20, 30), nullptr) << "no such node";
  ColorOcTreeNode* node = tree.updateNode(point3d(1, 1, 1), true);
  EXPECT_FALSE(node->isColorSet());
  tree.averageNodeColor(1, 1, 1, 10, 20, 30);
  EXPECT_EQ(node->getColor(), ColorOcTreeNode::Color(10, 20, 30));
  tree.averageNodeColor(tree.coordToKey(point3d(1, 1, 1)), 21, 21, 21);
  EXPECT_EQ(node->getColor(), ColorOcTreeNode::Color(15, 20, 25));
  tree.integrateNodeColor(1, 1, 1, 100, 100, 100);
  EXPECT_EQ(node->getColor(), ColorOcTreeNode::Color(39, 43, 46));
  std::ostringstream s;
  s << node->getColor();
  EXPECT_EQ(s.str(), "(39 43 46)");
}

TEST(Colour, SurvivesAStream) {
  const ColorOcTree tree = eightColours(true);
  std::stringstream s;
  ASSERT_TRUE(tree.write(s));
  const std::unique_ptr<AbstractOcTree> any(AbstractOcTree::read(s));
  const ColorOcTree* copy = dynamic_cast<ColorOcTree*>(any.get());
  ASSERT_NE(copy, nullptr);
  EXPECT_TRUE(*copy == tree);
  EXPECT_EQ(copy->search(cell(3))->getColor(), ColorOcTreeNode::Color(30, 100, 200));
}

TEST(Stamps, TellWhenANodeWasUpdated) {
  OcTreeStamped tree(0.1);
  OcTreeNodeStamped* node = tree.updateNode(point3d(1, 1, 1), true);
  EXPECT_GT(node->getTimestamp(), 1600000000U);
  EXPECT_GE(tree.getLastUpdateTime(), node->getTimestamp());
}

TEST(Stamps, KeepLeavesOfDifferentTimesApart) {
  OcTreeStamped tree(0.1);
  for (unsigned i = 0; i < 8; ++i) tree.updateNode(cell(i), true, true)->setTimestamp(1000 + (i == 7));
  tree.prune();
  EXPECT_EQ(tree.size(), 24U);
  tree.search(cell(7))->setTimestamp(1000);
  tree.prune();
  EXPECT_EQ(tree.size(), 16U);
}

TEST(Stamps, LetOldObstaclesFade) {
  OcTreeStamped tree(0.1);
  OcTreeNodeStamped* old = tree.updateNode(point3d(1, 1, 1), true);
  OcTreeNodeStamped* fresh = tree.updateNode(point3d(2, 2, 2), true);
  OcTreeNodeStamped* old_and_free = tree.updateNode(point3d(3, 3, 3), false);
  old->setTimestamp(1000);
  old_and_free->setTimestamp(1000);
  tree.degradeOutdatedNodes(100);
  EXPECT_EQ(old->getLogOdds(), tree.getProbHitLog() + tree.getProbMissLog());
  EXPECT_EQ(old->getTimestamp(), 1000U);
  EXPECT_EQ(fresh->getLogOdds(), tree.getProbHitLog());
  EXPECT_EQ(old_and_free->getLogOdds(), tree.getProbMissLog());
}

}  // namespace
