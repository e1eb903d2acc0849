// SPDX-License-Identifier: BSD-3-Clause
// Maps and scan graphs in files and streams.
#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <memory>
#include <sstream>

#include "../../test_files.hpp"
#include "../project/dice.hpp"

namespace {

using octomap::AbstractOcTree;
using octomap::OcTree;
using octomap::point3d;

class Files : public ::testing::Test {
 protected:
  Files() : tree_(0.1) {
    Dice dice(41);
    const point3d origin(1, 0, 0);
    tree_.insertPointCloud(roomScan(origin, 2000, dice), origin);
  }
  std::string path(const char* name) const { return folder_ / name; }

  rhmap::test::TempFolder folder_;
  OcTree tree_;
};

TEST_F(Files, WithAllValuesComeBackEqual) {
  ASSERT_TRUE(tree_.write(path("map.ot")));
  const std::unique_ptr<AbstractOcTree> any(AbstractOcTree::read(path("map.ot")));
  const OcTree* copy = dynamic_cast<OcTree*>(any.get());
  ASSERT_NE(copy, nullptr);
  EXPECT_TRUE(*copy == tree_);
}

TEST_F(Files, InBinaryFormComeBackAtTheirMostLikely) {
  ASSERT_TRUE(tree_.writeBinary(path("map.bt")));
  OcTree copy(5.0), again(path("map.bt"));
  ASSERT_TRUE(copy.readBinary(path("map.bt")));
  EXPECT_EQ(copy.getResolution(), 0.1);
  EXPECT_TRUE(copy == tree_);
  EXPECT_TRUE(again == tree_);
  for (OcTree::iterator it = copy.begin(), end = copy.end(); it != end; ++it) ASSERT_TRUE(copy.isNodeAtThreshold(*it));
}

TEST_F(Files, OfAnEmptyTreeHoldAnEmptyTree) {
  const OcTree empty(0.25);
  ASSERT_TRUE(empty.write(path("empty.ot")));
  ASSERT_TRUE(empty.writeBinaryConst(path("empty.bt")));
  const std::unique_ptr<AbstractOcTree> full(AbstractOcTree::read(path("empty.ot")));
  ASSERT_NE(full, nullptr);
  EXPECT_EQ(full->size(), 0U);
  EXPECT_EQ(full->getResolution(), 0.25);
  OcTree binary(0.1);
  EXPECT_TRUE(binary.readBinary(path("empty.bt")));
  EXPECT_EQ(binary.size(), 0U);
}

TEST_F(Files, ThatAreNotThereOrNoMapsAreRefused) {
  OcTree tree(0.1);
  EXPECT_FALSE(tree.readBinary(path("no_such_file.bt")));
  EXPECT_EQ(AbstractOcTree::read(path("no_such_file.ot")), nullptr);
  ASSERT_TRUE(tree_.write(path("map.ot")));
  EXPECT_FALSE(tree.readBinary(path("map.ot")));
  EXPECT_FALSE(tree_.write(path("no_such_folder/map.ot")));
  EXPECT_EQ(AbstractOcTree::createTree("NoSuchTree", 0.1), nullptr);
}

TEST_F(Files, OfAScanGraphComeBackPointByPoint) {
  octomap::ScanGraph graph;
  Dice dice(42);
  for (int i = 0; i < 3; ++i)
    graph.addNode(new octomap::Pointcloud(roomScan(point3d(0, 0, 0), 100, dice)),
                  octomap::pose6d(float(i), 0, 0, 0, 0, 0.5));
  graph.connectPrevious();
  ASSERT_TRUE(graph.writeBinary(path("scans.graph")));
  octomap::ScanGraph copy;
  ASSERT_TRUE(copy.readBinary(path("scans.graph")));
  ASSERT_EQ(copy.size(), 3U);
  EXPECT_EQ(copy.getNumPoints(), 300U);
  EXPECT_TRUE(copy.edgeExists(1, 2));
  OcTree tree(0.1), other(0.1);
  for (int i = 0; i < 3; ++i) {
    tree.insertPointCloud(*graph.getNodeByID(unsigned(i)));
    other.insertPointCloud(*copy.getNodeByID(unsigned(i)));
  }
  EXPECT_TRUE(tree == other);
}

TEST(Copies, AreEqualAndLiveOnTheirOwn) {
  OcTree tree(0.1);
  Dice dice(43);
  for (int i = 0; i < 5000; ++i) tree.updateNode(dice.point(1), dice.below(2) == 0);
  OcTree copy(tree);
  EXPECT_TRUE(copy == tree);
  copy.updateNode(point3d(5, 5, 5), true);
  EXPECT_FALSE(copy == tree);
  tree.swapContent(copy);
  EXPECT_NE(tree.search(point3d(5, 5, 5)), nullptr);
  EXPECT_EQ(copy.search(point3d(5, 5, 5)), nullptr);
  EXPECT_EQ(copy.size() < tree.size(), true);
}

}  // namespace
