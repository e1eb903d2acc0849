// SPDX-License-Identifier: BSD-3-Clause
// A map of so many regions that a block's reference to an octet is too small to name it among all octets: the regions
// belong to several districts (core/octet_pool.hpp). Whatever is done to it, OctoMap's bytes come out.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "oracle.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {
namespace {

using test::OctomapOracle;
using test::otBytes;

constexpr int kAlong = 60;  // regions
constexpr int kRegions = kAlong * kAlong * kAlong;

/// Cell `cell` of region `region` of a cube of regions.
OcTreeKey keyOf(int region, int cell) {
  const auto axis = [](int place, int cell_place) { return static_cast<key_type>(32000 + 8 * place + cell_place); };
  return {axis(region % kAlong, cell & 7), axis(region / kAlong % kAlong, cell >> 3 & 7),
          axis(region / kAlong / kAlong, cell >> 6)};
}

/// Nodes below this one and itself, found from their addresses alone.
std::size_t nodesFrom(const OcTree& tree, const OcTreeNode* node) {
  std::size_t nodes = 1;
  for (unsigned i = 0; i < 8; ++i)
    if (tree.nodeChildExists(node, i)) nodes += nodesFrom(tree, tree.getNodeChild(node, i));
  return nodes;
}

class ManyRegions : public testing::Test {
 protected:
  int below(int n) { return std::uniform_int_distribution(0, n - 1)(random_); }

  template <class F>
  void both(F&& call) {
    call(ours_);
    call(theirs_);
    ASSERT_EQ(ours_.size(), theirs_.size());
  }

  /// A few cells of each region, in an order that is not that of space.
  void fill() {
    for (int i = 0; i < kRegions; ++i) {
      const int region = static_cast<int>(std::int64_t{i} * 77'773 % kRegions);
      const OcTreeKey a = keyOf(region, below(512)), b = keyOf(region, below(512));
      both([&](auto& t) {
        t.updateNode(a, true, true);
        t.updateNode(b, false, true);
      });
      cells_.insert(cells_.end(), {a, b});
    }
    both([](auto& t) { t.updateInnerOccupancy(); });
  }

  std::mt19937 random_{7};
  std::vector<OcTreeKey> cells_;  // as they were filled
  OcTree ours_{0.1};
  OctomapOracle theirs_{0.1};
};

TEST_F(ManyRegions, AreOctoMaps) {
  fill();
  EXPECT_TRUE(otBytes(ours_) == otBytes(theirs_));
  EXPECT_EQ(nodesFrom(ours_, ours_.getRoot()), ours_.size());
}

TEST_F(ManyRegions, MayGoAndComeBack) {
  fill();
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (i / 2 % 3 != 0) both([&](auto& t) { t.deleteNode(cells_[i]); });  // with two regions of three
  ASSERT_EQ(ours_.size(), theirs_.size());
  fill();
  EXPECT_TRUE(otBytes(ours_) == otBytes(theirs_));
}

TEST_F(ManyRegions, TakeScansByTwoThreads) {
  fill();
  ours_.setNumThreads(2);
  octomap::Pointcloud scan;
  for (int i = 0; i < 2'000; ++i) scan.push_back(ours_.keyToCoord(keyOf(below(kRegions), below(512))));
  const octomap::point3d origin = ours_.keyToCoord(keyOf(0, 0));
  both([&](auto& t) { t.insertPointCloud(scan, origin); });
  EXPECT_TRUE(otBytes(ours_) == otBytes(theirs_));
}

}  // namespace
}  // namespace rhmap
