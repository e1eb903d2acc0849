// SPDX-License-Identifier: BSD-3-Clause
// Users' own node and tree classes, and subclasses of OcTree: one text on both libraries, the same answers and bytes.
#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <vector>

#include "oracle.hpp"
#include "rhmap/octree/color_octree.hpp"
#include "rhmap/octree/octree.hpp"
#include "tree_pair.hpp"

#define OCTO_KEY octomap::OcTreeKey
namespace on_octomap {
#define OCTO octomap
#include "user_tree.hpp"
#undef OCTO
}  // namespace on_octomap
namespace on_rhmap {
using rhmap::AbstractOcTree;
#define OCTO rhmap
#include "user_tree.hpp"
#undef OCTO
}  // namespace on_rhmap

namespace rhmap {
namespace {

using test::otBytes;

class UserTree : public test::TreePair<on_rhmap::HeatTree, on_octomap::HeatTree> {
 protected:
  void step() {
    switch (below(16)) {
      case 0: {
        const octomap::Pointcloud points = scan();
        const point3d origin = point();
        const double range = below(2) == 0 ? -1 : 1.1;
        const bool lazy = below(4) == 0, discretize = below(2) == 0;
        return both([&](auto& t) { t.insertPointCloud(points, origin, range, lazy, discretize); });
      }
      case 1: {
        const point3d from = ours_.keyToCoord(key()), to = ours_.keyToCoord(key());
        return both([&](auto& t) { t.insertRay(from, to); });
      }
      case 2:
        return both([](auto& t) { t.prune(); });
      case 3:
        return both([](auto& t) { t.updateInnerOccupancy(); });
      case 4:
        if (below(4) != 0) return;
        return both([](auto& t) { t.toMaxLikelihood(); });
      case 5:
        if (ours_.size() > 3000) return;
        return both([](auto& t) {
          if (t.getRoot() != nullptr && t.nodeHasChildren(t.getRoot())) t.expand();
        });
      case 6: {
        const OcTreeKey k = key();
        return both([&](auto& t) { t.warmUp(k, 0.4F); });
      }
      case 7: {
        const OcTreeKey k = key();
        return both([&](auto& t) { t.setNodeValue(k, -1.0F); });
      }
      case 8: {  // a copy goes on in place of the original
        std::stringstream ours(otBytes(ours_)), theirs(otBytes(theirs_));
        ASSERT_TRUE(ours.str() == theirs.str());
        const std::unique_ptr<AbstractOcTree> read(AbstractOcTree::read(ours));
        auto* tree = dynamic_cast<on_rhmap::HeatTree*>(read.get());
        ASSERT_NE(tree, nullptr) << "the factory does not know the user's class";
        EXPECT_TRUE(otBytes(*tree) == theirs.str());
        on_rhmap::HeatTree copy(*tree);
        EXPECT_TRUE(copy == *tree);
        EXPECT_TRUE(otBytes(copy) == theirs.str());
        return;
      }
      default: {
        const OcTreeKey k = key();
        const bool hit = below(2) == 0, lazy = below(6) == 0;
        return both([&](auto& t) { t.updateNode(k, hit, lazy); });
      }
    }
  }
};

TEST_P(UserTree, DoesTheSameOnBothLibraries) {
  EXPECT_EQ(ours_.halfWidth(), theirs_.halfWidth());
  for (int i = 0; i < 400; ++i) {
    ASSERT_NO_FATAL_FAILURE(step());
    ASSERT_EQ(ours_.size(), theirs_.size()) << "step " << i;
    ASSERT_EQ(ours_.rootHeat(), theirs_.rootHeat()) << "step " << i;
    ASSERT_TRUE(otBytes(ours_) == otBytes(theirs_)) << "step " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, UserTree, testing::Range(0U, 12U));

/// Like MoveIt's: members added, nothing overridden.
class TreeWithLock : public OcTree {
 public:
  using OcTree::OcTree;
  int callbacks = 0;
  float hitLogOdds() const { return prob_hit_log; }  // protected names
};

/// Overrides one call and counts.
class CountingUpdates : public OcTree {
 public:
  using OcTree::OcTree;
  using OcTree::updateNode;
  OcTreeNode* updateNode(const OcTreeKey& key, bool occupied, bool lazy_eval) override {
    ++(occupied ? hits : misses);
    return OcTree::updateNode(key, occupied, lazy_eval);
  }
  int hits = 0, misses = 0;
};

octomap::Pointcloud wall() {
  octomap::Pointcloud points;
  for (int i = -30; i < 30; ++i)
    for (int k = -10; k < 10; ++k)
      points.push_back(3.03F, 0.05F * static_cast<float>(i), 0.05F * static_cast<float>(k));
  return points;
}

TEST(Subclass, ThatOverridesNothingGivesTheSameMap) {
  TreeWithLock tree(0.1);
  OcTree plain(0.1);
  tree.insertPointCloud(wall(), point3d(0, 0, 0));
  plain.insertPointCloud(wall(), point3d(0, 0, 0));
  EXPECT_TRUE(otBytes(tree) == otBytes(plain));
  EXPECT_FLOAT_EQ(tree.hitLogOdds(), 0.847298F);
  AbstractOcTree* base = &tree;
  EXPECT_NE(dynamic_cast<OcTree*>(base), nullptr);
}

TEST(Subclass, ThatOverridesAnUpdateIsAskedForEveryCell) {
  CountingUpdates tree(0.1);
  OcTree plain(0.1);
  tree.insertPointCloud(wall(), point3d(0, 0, 0));
  plain.insertPointCloud(wall(), point3d(0, 0, 0));
  EXPECT_TRUE(otBytes(tree) == otBytes(plain));
  plain.expand();
  int occupied = 0, free = 0;
  for (const OcTreeNode& node : std::vector<OcTreeNode>(plain.begin_leafs(), plain.end_leafs()))
    ++(plain.isNodeOccupied(node) ? occupied : free);
  EXPECT_EQ(tree.hits, occupied);
  EXPECT_EQ(tree.misses, free);
}

TEST(NodesOnTheirOwn, HaveNoChildren) {
  OcTree tree(0.1);
  tree.updateNode(OcTreeKey(1, 2, 3), true);
  const OcTreeNode* root = tree.getRoot();
  EXPECT_TRUE(root->hasChildren());
  EXPECT_TRUE(root->childExists(0));
  EXPECT_FALSE(root->childExists(7));
  EXPECT_FALSE(tree.search(OcTreeKey(1, 2, 3))->hasChildren());

  const OcTreeNode copy = *root;  // not in the tree: a value and nothing else
  EXPECT_EQ(copy.getLogOdds(), root->getLogOdds());
  EXPECT_FALSE(copy.hasChildren());
  EXPECT_EQ(copy.getMaxChildLogOdds(), -FLT_MAX);

  const auto on_heap = std::make_unique<ColorOcTreeNode>();
  EXPECT_FALSE(on_heap->hasChildren());
  EXPECT_EQ(on_heap->getAverageChildColor(), ColorOcTreeNode::Color(255, 255, 255));
}

}  // namespace
}  // namespace rhmap
