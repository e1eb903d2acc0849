// SPDX-License-Identifier: BSD-3-Clause
// Iterators against recursion by child pointers, at all depths.
#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <vector>

#include "../project/dice.hpp"

namespace {

using octomap::OcTree;
using octomap::OcTreeKey;
using octomap::OcTreeNode;
using octomap::point3d;

struct Visit {
  const OcTreeNode* node;
  point3d centre;
  unsigned depth;
  bool leaf;
};

/// Nodes down to `max_depth`, parents first.
void recurse(const OcTree& tree, const OcTreeNode* node, const point3d& centre, unsigned depth, unsigned max_depth,
             std::vector<Visit>& visits) {
  const bool leaf = depth == max_depth || !tree.nodeHasChildren(node);
  visits.push_back({node, centre, depth, leaf});
  if (leaf) return;
  const float step = float(tree.getNodeSize(depth + 1)) / 2;
  for (unsigned i = 0; i < 8; ++i) {
    if (!tree.nodeChildExists(node, i)) continue;
    const point3d offset(i & 1 ? step : -step, i & 2 ? step : -step, i & 4 ? step : -step);
    recurse(tree, tree.getNodeChild(node, i), centre + offset, depth + 1, max_depth, visits);
  }
}

std::vector<Visit> recurse(const OcTree& tree, unsigned max_depth) {
  std::vector<Visit> visits;
  recurse(tree, tree.getRoot(), point3d(0, 0, 0), 0, max_depth == 0 ? 16 : max_depth, visits);
  return visits;
}

template <class Iterator>
void expectAt(const Iterator& it, const Visit& visit, const OcTree& tree) {
  ASSERT_EQ(&*it, visit.node);
  ASSERT_EQ(it.getDepth(), visit.depth);
  ASSERT_EQ(it.getSize(), tree.getNodeSize(visit.depth));
  ASSERT_NEAR((it.getCoordinate() - visit.centre).norm(), 0, 1e-4);
  const OcTreeKey root(32768, 32768, 32768);
  ASSERT_EQ(it.getKey(), visit.depth == 0 ? root : tree.coordToKey(visit.centre, visit.depth));
  ASSERT_EQ(it.getIndexKey(), octomap::computeIndexKey(octomap::key_type(16 - visit.depth), it.getKey()));
  ASSERT_EQ(visit.depth == 0 ? tree.getRoot() : tree.search(it.getKey(), it.getDepth()), visit.node);
}

/// Of the room's map: leaves of several sizes.
class Iterators : public ::testing::Test {
 protected:
  Iterators() : tree_(0.1) {
    Dice dice(31);
    for (int i = 0; i < 6; ++i) {
      const point3d origin(float(i) - 3, 0, 0);
      tree_.insertPointCloud(roomScan(origin, 1500, dice), origin);
    }
    tree_.toMaxLikelihood();
    tree_.prune();
  }
  OcTree tree_;
};

TEST_F(Iterators, VisitTheTreeAsRecursionDoes) {
  for (unsigned depth = 0; depth <= 16; ++depth) {
    const std::vector<Visit> visits = recurse(tree_, depth);
    std::size_t n = 0;
    for (OcTree::tree_iterator it = tree_.begin_tree(static_cast<unsigned char>(depth)), end = tree_.end_tree();
         it != end; ++it, ++n) {
      ASSERT_LT(n, visits.size());
      expectAt(it, visits[n], tree_);
      ASSERT_EQ(it.isLeaf(), visits[n].leaf);
      if (HasFatalFailure()) return;
    }
    EXPECT_EQ(n, visits.size()) << "depth " << depth;
  }
  EXPECT_EQ(recurse(tree_, 16).size(), tree_.size());
}

TEST_F(Iterators, VisitTheLeavesAsRecursionDoes) {
  for (unsigned depth = 0; depth <= 16; ++depth) {
    std::vector<Visit> leaves;
    for (const Visit& visit : recurse(tree_, depth))
      if (visit.leaf) leaves.push_back(visit);
    std::size_t n = 0;
    for (OcTree::leaf_iterator it = tree_.begin_leafs(static_cast<unsigned char>(depth)); it != tree_.end_leafs();
         it++, ++n) {
      ASSERT_LT(n, leaves.size());
      expectAt(it, leaves[n], tree_);
      if (HasFatalFailure()) return;
    }
    EXPECT_EQ(n, leaves.size()) << "depth " << depth;
  }
}

TEST_F(Iterators, OfABoxVisitTheLeavesThatTouchIt) {
  Dice dice(32);
  std::size_t found = 0;
  for (int round = 0; round < 20; ++round) {
    const OcTreeKey a = tree_.coordToKey(dice.point(3)), b = tree_.coordToKey(dice.point(3));
    const OcTreeKey min(std::min(a[0], b[0]), std::min(a[1], b[1]), std::min(a[2], b[2]));
    const OcTreeKey max(std::max(a[0], b[0]), std::max(a[1], b[1]), std::max(a[2], b[2]));
    // On its upper side OctoMap takes a pruned leaf for one cell larger than it is.
    const auto touches = [&](const OcTree::leaf_iterator& it) {
      const int edge = 1 << (16 - it.getDepth());
      for (unsigned i = 0; i < 3; ++i) {
        const int low = it.getIndexKey()[i], high = low + edge - (edge == 1 ? 1 : 0);
        if (high < min[i] || low > max[i]) return false;
      }
      return true;
    };
    OcTree::leaf_bbx_iterator in_box = tree_.begin_leafs_bbx(min, max);
    for (OcTree::iterator it = tree_.begin(), end = tree_.end(); it != end; ++it) {
      if (!touches(it)) continue;
      ASSERT_NE(in_box, tree_.end_leafs_bbx());
      ASSERT_EQ(&*in_box, &*it);
      ++in_box, ++found;
    }
    EXPECT_EQ(in_box, tree_.end_leafs_bbx());
  }
  EXPECT_GT(found, 1000U);
}

TEST_F(Iterators, AreCopiedAndCompared) {
  OcTree::leaf_iterator it = tree_.begin_leafs(), other;
  EXPECT_EQ(other, tree_.end_leafs());
  other = it;
  EXPECT_EQ(it, other);
  EXPECT_EQ(it++, other);
  EXPECT_NE(it, other);
  EXPECT_EQ(it, ++other);
  it->setValue(3.25F);
  EXPECT_EQ((*other).getValue(), 3.25F);
}

TEST(EmptyTree, HasNothingToIterate) {
  const OcTree tree(0.1);
  EXPECT_EQ(tree.begin(), tree.end());
  EXPECT_EQ(tree.begin_leafs(), tree.end_leafs());
  EXPECT_EQ(tree.begin_tree(), tree.end_tree());
  EXPECT_EQ(tree.begin_leafs_bbx(point3d(-1, -1, -1), point3d(1, 1, 1)), tree.end_leafs_bbx());
}

}  // namespace
