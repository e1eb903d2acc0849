// SPDX-License-Identifier: BSD-3-Clause
#include "../../tools/map_difference.hpp"

#include <gtest/gtest.h>

namespace rhmap::tools {
namespace {

constexpr key_type kMid = kTreeMaxVal;

/// A cube of cells with its smallest corner at the middle of the world.
OcTree cubeOf(int edge, float log_odds) {
  OcTree tree(0.1);
  for (int x = 0; x < edge; ++x)
    for (int y = 0; y < edge; ++y)
      for (int z = 0; z < edge; ++z)
        tree.setNodeValue(OcTreeKey(key_type(kMid + x), key_type(kMid + y), key_type(kMid + z)), log_odds);
  return tree;
}

TEST(MapDifference, IsNoneBetweenAMapAndItself) {
  const OcTree tree = cubeOf(3, 1.F);
  const MapDifference difference = differenceOf(tree, tree);
  EXPECT_EQ(difference.known, 27U);
  EXPECT_EQ(difference.states, 0U);
  EXPECT_EQ(difference.values, 0U);
}

TEST(MapDifference, DoesNotSeePruning) {
  const OcTree pruned = cubeOf(4, 1.F);
  OcTree expanded(pruned);
  expanded.expand();
  ASSERT_NE(pruned.size(), expanded.size());
  EXPECT_EQ(differenceOf(pruned, expanded).values, 0U);
  EXPECT_EQ(differenceOf(expanded, pruned).known, 64U);
}

TEST(MapDifference, CountsCellsOfLargeLeaves) {
  const OcTree cube = cubeOf(4, 1.F), empty(0.1);
  for (const MapDifference& difference : {differenceOf(cube, empty), differenceOf(empty, cube)}) {
    EXPECT_EQ(difference.known, 64U);
    EXPECT_EQ(difference.states, 64U);
    EXPECT_EQ(difference.values, 64U);
  }
}

TEST(MapDifference, TellsStatesFromValues) {
  const OcTree cube = cubeOf(4, 1.F);
  OcTree other(cube);
  other.setNodeValue(OcTreeKey(kMid, kMid, kMid), 2.F);       // still occupied
  other.setNodeValue(OcTreeKey(kMid, kMid, kMid + 1), -1.F);  // free now
  other.deleteNode(OcTreeKey(kMid, kMid, kMid + 2));          // unknown now
  other.setNodeValue(OcTreeKey(kMid + 4, kMid, kMid), 1.F);   // known now
  const MapDifference difference = differenceOf(cube, other);
  EXPECT_EQ(difference.known, 65U);
  EXPECT_EQ(difference.states, 3U);
  EXPECT_EQ(difference.values, 4U);
}

TEST(MapDifference, OfNothingIsNothing) { EXPECT_EQ(differenceOf(OcTree(0.1), OcTree(0.1)).known, 0U); }

}  // namespace
}  // namespace rhmap::tools
