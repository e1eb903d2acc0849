// SPDX-License-Identifier: BSD-3-Clause
// Maps that cross the bridge to stock OctoMap and back are the same to the bit.
#include "random_maps.hpp"

#include "rhmap/baseline/octomap_bridge.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace rhmap {
namespace {

using test::otBytes;
using test::RandomMaps;

class OctomapBridge : public testing::TestWithParam<unsigned> {};

TEST_P(OctomapBridge, GivesTheTreeThatOctomapWouldHoldAndTheMapBack) {
  RandomMaps maps(GetParam());
  for (int i = 0; i < 400; ++i) {
    maps.step();
    if (i % 10 != 0) continue;
    const auto tree = toOctomap(maps.ours());
    ASSERT_EQ(tree->size(), maps.theirs().size()) << i;
    ASSERT_EQ(tree->calcNumNodes(), maps.theirs().size()) << i;
    ASSERT_TRUE(otBytes(*tree) == otBytes(maps.theirs())) << i;
    ASSERT_EQ(tree->getResolution(), maps.theirs().getResolution());
    ASSERT_EQ(test::model(*tree), test::model(maps.theirs()));

    const OcTree back = fromOctomap(*tree);
    ASSERT_TRUE(back == maps.ours()) << i;
    ASSERT_TRUE(otBytes(back) == otBytes(maps.ours())) << i;
    ASSERT_EQ(back.getResolution(), maps.ours().getResolution());
    ASSERT_EQ(test::model(back), test::model(maps.ours()));
    ASSERT_TRUE(*toOctomap(back) == *tree) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, OctomapBridge, testing::Range(1U, 13U));

TEST(OctomapBridge, KeepsAnEmptyMapEmpty) {
  const auto tree = toOctomap(OcTree(0.25));
  EXPECT_EQ(tree->getRoot(), nullptr);
  EXPECT_EQ(tree->size(), 0U);
  EXPECT_EQ(tree->getResolution(), 0.25);
  const OcTree back = fromOctomap(octomap::OcTree(0.25));
  EXPECT_EQ(back.size(), 0U);
  EXPECT_EQ(back.getRoot(), nullptr);
}

TEST(OctomapBridge, KeepsARootWithoutChildren) {
  OcTree map(0.1);
  map.updateNode(1, 1, 1, true);
  map.getRoot()->setLogOdds(0.5F);
  for (unsigned i = 0; i < 8; ++i) map.deleteNodeChild(map.getRoot(), i);
  const auto tree = toOctomap(map);
  ASSERT_EQ(tree->size(), 1U);
  EXPECT_EQ(tree->getRoot()->getLogOdds(), 0.5F);
  EXPECT_FALSE(tree->nodeHasChildren(tree->getRoot()));
  const OcTree back = fromOctomap(*tree);
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back.getRoot()->getLogOdds(), 0.5F);
}

TEST(OctomapBridge, MakesATreeThatLivesOn) {
  RandomMaps maps(7);
  for (int i = 0; i < 300; ++i) maps.step();
  const auto tree = toOctomap(maps.ours());
  for (int i = 0; i < 3000; ++i) {
    const OcTreeKey key = maps.key();
    const bool hit = maps.below(2) == 0;
    tree->updateNode(key, hit);
    maps.theirs().updateNode(key, hit);
  }
  EXPECT_TRUE(otBytes(*tree) == otBytes(maps.theirs()));
}

TEST(OctomapBridge, RefusesATreeWithChildrenBelowDepth16) {
  octomap::OcTree tree(0.1);
  octomap::OcTreeNode* cell = tree.updateNode(1, 1, 1, true);
  tree.createNodeChild(cell, 0);
  EXPECT_THROW(fromOctomap(tree), std::invalid_argument);
  tree.pruneNode(cell);
  for (unsigned i = 1; i < 8; ++i) tree.createNodeChild(cell, i);
  for (unsigned i = 0; i < 8; ++i) tree.getNodeChild(cell, i)->setLogOdds(1);
  tree.pruneNode(cell);  // gives the array back, which would otherwise offend OctoMap's destructor
}

}  // namespace
}  // namespace rhmap
