// SPDX-License-Identifier: BSD-3-Clause
// Keys, coordinates, and sets of keys.
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

namespace {

using octomap::KeySet;
using octomap::OcTree;
using octomap::OcTreeKey;
using octomap::point3d;

TEST(Keys, NameCellsByTheirDistanceFromTheOrigin) {
  const OcTree tree(0.1);
  EXPECT_EQ(tree.coordToKey(0.0), 32768);
  EXPECT_EQ(tree.coordToKey(0.1), 32769);
  EXPECT_EQ(tree.coordToKey(-0.01), 32767);
  EXPECT_EQ(tree.keyToCoord(32768), 0.05);
  EXPECT_EQ(tree.coordToKey(point3d(1.05F, -1.05F, 0)), OcTreeKey(32778, 32757, 32768));
  for (unsigned k = 0; k < 65536; k += 97) {
    const octomap::key_type key = octomap::key_type(k);
    ASSERT_EQ(tree.coordToKey(tree.keyToCoord(key)), key);
  }
}

TEST(Keys, NameNodesByTheirCentre) {
  const OcTree tree(0.1);
  const OcTreeKey key(32771, 40000, 12345);
  for (unsigned depth = 1; depth <= 16; ++depth) {
    const OcTreeKey node = tree.adjustKeyAtDepth(key, depth);
    ASSERT_EQ(tree.adjustKeyAtDepth(node, depth), node);
    const point3d centre = tree.keyToCoord(node, depth);
    ASSERT_EQ(tree.coordToKey(centre, depth), node) << depth;
    for (unsigned i = 0; i < 3; ++i)
      ASSERT_LE(std::abs(tree.keyToCoord(key[i]) - centre(i)), tree.getNodeSize(depth) / 2) << depth;
  }
}

TEST(Keys, OutsideOfTheTreeAreRefused) {
  const OcTree tree(0.1);
  OcTreeKey key;
  EXPECT_TRUE(tree.coordToKeyChecked(point3d(3276.7F, 0, -3276.7F), key));
  EXPECT_FALSE(tree.coordToKeyChecked(3276.81, 0, 0, key));
  EXPECT_FALSE(tree.coordToKeyChecked(0, -3276.81, 0, key));
  EXPECT_FALSE(tree.coordToKeyChecked(point3d(0, 0, 1e9F), key));
  octomap::key_type one;
  EXPECT_FALSE(tree.coordToKeyChecked(4000.0, one));
  EXPECT_TRUE(tree.coordToKeyChecked(-3276.75, 16, one));
}

TEST(Keys, OfChildrenAreFoundFromTheParent) {
  const OcTreeKey parent(32776, 32776, 32776);
  for (unsigned i = 0; i < 8; ++i) {
    OcTreeKey child;
    octomap::computeChildKey(i, 4, parent, child);
    EXPECT_EQ(octomap::computeChildIdx(child, 3), i);
    EXPECT_EQ(child[0], i & 1 ? 32780 : 32772);
    EXPECT_EQ(child[2], i & 4 ? 32780 : 32772);
  }
  EXPECT_EQ(octomap::computeIndexKey(4, OcTreeKey(31, 32, 65535)), OcTreeKey(16, 32, 65520));
}

TEST(Keys, AreKeptInSets) {
  KeySet keys;
  const OcTreeKey a(1, 2, 3), b(65535, 0, 32768);
  EXPECT_TRUE(keys.insert(a).second);
  EXPECT_FALSE(keys.insert(a).second);
  keys.insert(b);
  EXPECT_EQ(keys.size(), 2U);
  EXPECT_EQ(*keys.find(b), b);
  EXPECT_EQ(keys.find(OcTreeKey(9, 9, 9)), keys.end());
  EXPECT_EQ(keys.erase(a), 1U);
  EXPECT_EQ(keys.count(a), 0U);
  const KeySet copy(keys);
  keys.clear();
  EXPECT_TRUE(keys.empty());
  ASSERT_EQ(copy.size(), 1U);
  EXPECT_EQ(*copy.begin(), b);

  octomap::KeyRay ray;
  ray.addKey(a);
  ray.addKey(b);
  ray.addKey(a);
  EXPECT_EQ(KeySet(ray.begin(), ray.end()).size(), 2U);
  KeySet all;
  for (unsigned i = 0; i < 4096; ++i)
    all.insert(OcTreeKey(octomap::key_type(i * 37), octomap::key_type(i % 64), octomap::key_type(i / 64)));
  EXPECT_EQ(all.size(), 4096U);
  for (KeySet::iterator it = all.begin(); it != all.end();) {
    if ((*it)[1] % 2 == 0) {
      it = all.erase(it);
    } else {
      ++it;
    }
  }
  EXPECT_EQ(all.size(), 2048U);
}

}  // namespace
