// SPDX-License-Identifier: BSD-3-Clause
// Change detection, and the box that limits scans.
#include <gtest/gtest.h>
#include <octomap/octomap.h>

namespace {

using octomap::KeyBoolMap;
using octomap::OcTree;
using octomap::OcTreeKey;
using octomap::point3d;
using octomap::Pointcloud;

struct Changes {
  unsigned created = 0, flipped = 0;
  bool operator==(const Changes&) const = default;
};
std::ostream& operator<<(std::ostream& s, const Changes& c) {
  return s << c.created << " created, " << c.flipped << " flipped";
}

/// Since the last call.
Changes changes(OcTree& tree) {
  Changes counts;
  for (KeyBoolMap::const_iterator it = tree.changedKeysBegin(); it != tree.changedKeysEnd(); ++it) {
    EXPECT_NE(tree.search(it->first), nullptr);
    ++(it->second ? counts.created : counts.flipped);
  }
  EXPECT_EQ(tree.numChangesDetected(), counts.created + counts.flipped);
  tree.resetChangeDetection();
  return counts;
}

TEST(ChangedKeys, AreNotKeptUnlessAsked) {
  OcTree tree(0.1);
  EXPECT_FALSE(tree.isChangeDetectionEnabled());
  tree.updateNode(point3d(1, 1, 1), true);
  EXPECT_EQ(changes(tree), Changes());
}

TEST(ChangedKeys, AreNewCellsAndCellsThatFlip) {
  OcTree tree(0.1);
  tree.enableChangeDetection(true);
  const point3d a(1, 1, 1), b(1, 1, 1.2F);
  tree.updateNode(a, true);
  tree.updateNode(b, false);
  EXPECT_EQ(changes(tree), (Changes{.created = 2}));
  tree.updateNode(a, true);
  tree.updateNode(b, false);
  EXPECT_EQ(changes(tree), Changes());
  for (int i = 0; i < 5; ++i) tree.updateNode(a, false);
  tree.updateNode(b, 2.0F);
  EXPECT_EQ(changes(tree), (Changes{.flipped = 2}));
  tree.updateNode(b, -3.0F);
  tree.updateNode(b, 3.0F);
  EXPECT_EQ(changes(tree), Changes()) << "there and back";
  tree.updateNode(point3d(2, 2, 2), true);
  tree.updateNode(point3d(2, 2, 2), -3.0F);
  EXPECT_EQ(changes(tree), (Changes{.created = 1})) << "new, whatever happened since";
}

TEST(ChangedKeys, OfScansAreTheCellsOfTheRays) {
  OcTree tree(0.1);
  tree.enableChangeDetection(true);
  Pointcloud wall;
  for (int i = -20; i <= 20; ++i)
    for (int k = -20; k <= 20; ++k) wall.push_back(point3d(3, 0.1F * float(i), 0.1F * float(k)));
  tree.insertPointCloud(wall, point3d(0, 0, 0));
  const Changes first = changes(tree);
  EXPECT_EQ(first, (Changes{.created = 19200}));
  tree.insertPointCloud(wall, point3d(0, 0, 0));
  EXPECT_EQ(changes(tree), Changes());

  Pointcloud behind;
  for (const point3d& p : wall) behind.push_back(p * 1.5F);
  for (int i = 0; i < 6; ++i) tree.insertPointCloud(behind, point3d(0, 0, 0));
  const Changes later = changes(tree);
  EXPECT_EQ(later, (Changes{.created = 34966, .flipped = 1089}));
}

TEST(ChangedKeys, NameCellsOfPrunedLeaves) {
  OcTree tree(0.1);
  for (unsigned i = 0; i < 8; ++i)
    tree.updateNode(OcTreeKey(octomap::key_type(i & 1), octomap::key_type(i >> 1 & 1), octomap::key_type(i >> 2)),
                    true);
  ASSERT_EQ(tree.getNumLeafNodes(), 1U);
  tree.enableChangeDetection(true);
  tree.updateNode(OcTreeKey(1, 1, 0), -3.0F);
  ASSERT_EQ(tree.getNumLeafNodes(), 8U);
  ASSERT_EQ(tree.numChangesDetected(), 1U);
  EXPECT_EQ(tree.changedKeysBegin()->first, OcTreeKey(1, 1, 0));
  EXPECT_FALSE(tree.changedKeysBegin()->second);
}

#ifdef RHMAP_COMPAT_OCTOMAP  // OctoMap 1.10's rules, which the installed 1.9.7 does not have
TEST(Box, LimitsWhatAScanMarks) {
  OcTree tree(0.1);
  tree.useBBXLimit(true);
  tree.setBBXMin(point3d(-1, -1, -1));
  tree.setBBXMax(point3d(1, 1, 1));
  EXPECT_TRUE(tree.bbxSet());
  EXPECT_EQ(tree.getBBXCenter(), point3d(0, 0, 0));
  EXPECT_EQ(tree.getBBXBounds(), point3d(1, 1, 1));
  Pointcloud scan;
  scan.push_back(0.75F, 0.05F, 0.05F);  // inside
  scan.push_back(0.05F, 3.0F, 0.05F);   // outside: free up to the box
  tree.insertPointCloud(scan, point3d(0.05F, 0.05F, 0.05F));
  EXPECT_TRUE(tree.isNodeOccupied(tree.search(0.75, 0.05, 0.05)));
  EXPECT_FALSE(tree.isNodeOccupied(tree.search(0.05, 0.95, 0.05)));
  EXPECT_EQ(tree.search(0.05, 1.25, 0.05), nullptr);
  EXPECT_EQ(tree.search(0.05, 3.0, 0.05), nullptr);
  for (OcTree::iterator it = tree.begin(), end = tree.end(); it != end; ++it)
    EXPECT_TRUE(tree.inBBX(it.getKey())) << it.getCoordinate();

  OcTree from_outside(0.1);
  from_outside.useBBXLimit(true);
  from_outside.setBBXMin(point3d(-1, -1, -1));
  from_outside.setBBXMax(point3d(1, 1, 1));
  from_outside.insertPointCloud(scan, point3d(-3, 0.05F, 0.05F));
  EXPECT_EQ(from_outside.getNumLeafNodes(), 1U) << "the end that lies in the box";
}
#endif

}  // namespace
