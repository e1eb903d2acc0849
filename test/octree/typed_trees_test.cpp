// SPDX-License-Identifier: BSD-3-Clause
// ColorOcTree, OcTreeStamped and CountingOcTree against OctoMap's, on the same random calls.
#include <gtest/gtest.h>

#include "oracle.hpp"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTreeStamped.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>
#include <random>
#include <sstream>
#include <thread>

#include "../test_files.hpp"
#include "octomap_counting.hpp"
#include "rhmap/octree/color_octree.hpp"
#include "rhmap/octree/counting_octree.hpp"
#include "rhmap/octree/map_file.hpp"
#include "rhmap/octree/octree.hpp"
#include "rhmap/octree/stamped_octree.hpp"
#include "tree_pair.hpp"

/// The clock of this program, liboctomap.so included: stands still unless a test moves it.
static std::time_t now = 1000;
extern "C" std::time_t time(std::time_t* t) noexcept {
  if (t != nullptr) *t = now;
  return now;
}

namespace rhmap {
namespace {

using test::otBytes;

template <class OURS, class THEIRS>
class Pair : public test::TreePair<OURS, THEIRS> {
 protected:
  using test::TreePair<OURS, THEIRS>::ours_;
  using test::TreePair<OURS, THEIRS>::theirs_;
  using test::TreePair<OURS, THEIRS>::below;
  using test::TreePair<OURS, THEIRS>::key;
  using test::TreePair<OURS, THEIRS>::both;

  /// Calls that every occupancy tree has.
  void occupancyStep() {
    switch (below(10)) {
      case 0: {
        const octomap::Pointcloud points = this->scan();
        const point3d origin = this->point();
        const bool lazy = below(4) == 0, discretize = below(2) == 0;
        return both([&](auto& t) { t.insertPointCloud(points, origin, 1.3, lazy, discretize); });
      }
      case 1:
        return both([](auto& t) { t.prune(); });
      case 2:
        return both([](auto& t) { t.updateInnerOccupancy(); });
      case 3:
        if (ours_.size() > 3000) return;
        return both([](auto& t) {
          if (t.getRoot() != nullptr && t.nodeHasChildren(t.getRoot())) t.expand();
        });
      case 4: {
        const OcTreeKey k = key();
        return both([&](auto& t) { t.setNodeValue(k, 0.75F); });
      }
      default: {
        const OcTreeKey k = key();
        const bool hit = below(2) == 0, lazy = below(8) == 0;
        return both([&](auto& t) { t.updateNode(k, hit, lazy); });
      }
    }
  }
  void expectSame() {
    ASSERT_EQ(ours_.size(), theirs_.size());
    ASSERT_TRUE(otBytes(ours_) == otBytes(theirs_));
    std::stringstream s(otBytes(ours_));
    const std::unique_ptr<AbstractOcTree> read(AbstractOcTree::read(s));
    ASSERT_NE(dynamic_cast<OURS*>(read.get()), nullptr);
    ASSERT_TRUE(otBytes(*read) == s.str());
  }
};

// --- colour ---

class ColorParity : public Pair<ColorOcTree, octomap::ColorOcTree> {
 protected:
  void colorStep() {
    const OcTreeKey k = key();
    const auto channel = [&] { return static_cast<std::uint8_t>(below(4) == 0 ? 255 : below(256)); };
    const std::uint8_t r = channel(), g = channel(), b = channel();
    const point3d p = ours_.keyToCoord(k);
    switch (below(6)) {
      case 0:
        return both([&](auto& t) { t.setNodeColor(k, r, g, b); });
      case 1:
        return both([&](auto& t) { t.averageNodeColor(k, r, g, b); });
      case 2:
        return both([&](auto& t) { t.integrateNodeColor(k, r, g, b); });
      case 3:
        return both([&](auto& t) { t.setNodeColor(p.x(), p.y(), p.z(), r, g, b); });
      case 4:
        return both([&](auto& t) { t.averageNodeColor(p.x(), p.y(), p.z(), r, g, b); });
      default:
        return both([&](auto& t) { t.integrateNodeColor(p.x(), p.y(), p.z(), r, g, b); });
    }
  }
};

TEST_P(ColorParity, RandomCalls) {
  both([](auto& t) { t.updateNode(OcTreeKey(32768, 32768, 32768), true); });  // OctoMap's updateInner needs a root
  for (int i = 0; i < 400; ++i) {
    below(2) == 0 ? colorStep() : occupancyStep();
    ASSERT_NO_FATAL_FAILURE(expectSame()) << "step " << i;
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, ColorParity, testing::Range(0U, 12U));

TEST(ColorOcTree, PruningTakesTheMeanColour) {
  ColorOcTree tree(0.1);
  for (unsigned i = 0; i < 8; ++i) {
    const auto axis = [i](unsigned bit) { return static_cast<key_type>(32768 + (i >> bit & 1)); };
    const OcTreeKey k(axis(0), axis(1), axis(2));
    tree.updateNode(k, 1.0F, true);
    tree.setNodeColor(k, static_cast<std::uint8_t>(i * 10), 100, 0);
  }
  EXPECT_EQ(tree.size(), 1U + 15 + 8);
  tree.updateInnerOccupancy();
  EXPECT_EQ(tree.getRoot()->getColor(), ColorOcTreeNode::Color(35, 100, 0));
  tree.prune();
  EXPECT_EQ(tree.size(), 1U + 15);
  const ColorOcTreeNode* pruned = tree.search(OcTreeKey(32769, 32769, 32769));
  ASSERT_NE(pruned, nullptr);
  EXPECT_EQ(pruned->getColor(), ColorOcTreeNode::Color(35, 100, 0));

  ColorOcTree copy(tree);  // with its colours, which OctoMap's copies lose
  EXPECT_TRUE(copy == tree);
  EXPECT_TRUE(otBytes(copy) == otBytes(tree));
}

TEST(ColorOcTree, PrintsColoursAsOctomapDoes) {
  std::ostringstream ours, theirs;
  ours << ColorOcTreeNode::Color(1, 20, 255);
  theirs << octomap::ColorOcTreeNode::Color(1, 20, 255);
  EXPECT_EQ(ours.str(), theirs.str());
}

TEST(ColorOcTree, UnknownCellsCannotBeColoured) {
  ColorOcTree tree(0.1);
  EXPECT_EQ(tree.setNodeColor(OcTreeKey(1, 2, 3), 1, 2, 3), nullptr);
  EXPECT_EQ(tree.averageNodeColor(1e9F, 0, 0, 1, 2, 3), nullptr);
  EXPECT_EQ(tree.integrateNodeColor(0, 0, 0, 1, 2, 3), nullptr);
  EXPECT_EQ(tree.size(), 0U);
  tree.updateInnerOccupancy();
}

TEST(ColorOcTree, HandsOctomapsPlotToGnuplot) {
  ColorOcTree ours(0.1);
  octomap::ColorOcTree theirs(0.1);
  const auto fill = [](auto& tree) {
    for (int i = 0; i < 40; ++i) {
      const OcTreeKey k(static_cast<key_type>(32768 + 3 * i), 32768, 32768);
      tree.updateNode(k, i % 5 != 0);
      if (i % 4 != 0) tree.setNodeColor(k, static_cast<std::uint8_t>(i % 7), static_cast<std::uint8_t>(i), 9);
    }
    tree.updateInnerOccupancy();
  };
  fill(ours);
  fill(theirs);
  // A gnuplot that keeps what it is given, as a file or through a pipe.
  const test::TempFolder folder;
  const std::filesystem::path program = folder / "gnuplot", given = folder / "given";
  test::writeText(program, "#!/bin/sh\ncat \"$@\" > " + given.string() + "\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string path = getenv("PATH");
  setenv("PATH", (folder.path().string() + ":" + path).c_str(), 1);
  theirs.writeColorHistogram("colors.eps");
  std::string expected;  // OctoMap leaves the pipe open and does not wait
  for (int i = 0; i < 1000 && std::count(expected.begin(), expected.end(), '\n') < 3 + 6 * 257 + 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    expected = test::readText(given);
  }
  ours.writeColorHistogram("colors.eps");
  EXPECT_EQ(test::readText(given).substr(0, 400), expected.substr(0, 400));
  EXPECT_TRUE(test::readText(given) == expected);

  test::writeText(program, "#!/bin/sh\nexit 3\n");
  EXPECT_THROW(ours.writeColorHistogram("colors.eps"), std::runtime_error);
  setenv("PATH", path.c_str(), 1);
}

// --- time stamps ---

class StampedParity : public Pair<OcTreeStamped, octomap::OcTreeStamped> {};

TEST_P(StampedParity, RandomCalls) {
  now = 1000;
  for (int i = 0; i < 300; ++i) {
    if (below(5) == 0) now += below(3);
    if (below(12) == 0) {
      const auto age = static_cast<unsigned>(below(6));
      both([&](auto& t) { t.degradeOutdatedNodes(age); });
    }
    occupancyStep();
    ASSERT_NO_FATAL_FAILURE(expectSame()) << "step " << i;
    auto a = ours_.begin_tree();
    for (auto b = theirs_.begin_tree(); b != theirs_.end_tree(); ++a, ++b)
      ASSERT_EQ(a->getTimestamp(), b->getTimestamp()) << "step " << i << ", depth " << b.getDepth();
    if (theirs_.size() > 0) {
      ASSERT_EQ(ours_.getLastUpdateTime(), theirs_.getLastUpdateTime());
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, StampedParity, testing::Range(0U, 8U));

TEST(OcTreeStamped, OldOccupiedLeavesDegrade) {
  now = 1000;
  OcTreeStamped tree(0.1);
  EXPECT_EQ(tree.getLastUpdateTime(), 0U);
  OcTreeNodeStamped* node = tree.updateNode(OcTreeKey(1, 2, 3), true);
  const float before = node->getLogOdds();
  EXPECT_EQ(node->getTimestamp(), 1000U);
  now = 1010;
  tree.degradeOutdatedNodes(10);
  EXPECT_EQ(node->getLogOdds(), before);
  tree.degradeOutdatedNodes(9);
  EXPECT_EQ(node->getLogOdds(), before + tree.getProbMissLog());
  EXPECT_EQ(node->getTimestamp(), 1000U);
  EXPECT_EQ(tree.getLastUpdateTime(), 1000U);
}

// --- counts ---

TEST(CountingOcTree, RandomCallsGiveOctomapsTree) {
  std::mt19937 random(7);
  CountingOcTree ours(0.1);
  test::OctomapCounting theirs(0.1);
  const auto below = [&](int n) { return std::uniform_int_distribution(0, n - 1)(random); };
  for (int i = 0; i < 1000; ++i) {
    const int extent = below(3) == 0 ? 24 : 4;
    const auto axis = [&] { return static_cast<key_type>(32764 + below(extent)); };
    const OcTreeKey k(axis(), axis(), axis());
    ASSERT_EQ(ours.updateNode(k)->getCount(), theirs.update(k));
    ASSERT_EQ(ours.updateNode(ours.keyToCoord(k))->getCount(), theirs.update(k));
    if (below(10) == 0) {
      ours.prune();
      theirs.prune();
    }
    ASSERT_TRUE(otBytes(ours) == theirs.bytes()) << "step " << i;
    const auto hits = static_cast<unsigned>(below(6));
    octomap::point3d_list centers;
    ours.getCentersMinHits(centers, hits);
    ASSERT_TRUE(centers == theirs.centers(hits)) << "step " << i;
  }
  EXPECT_EQ(ours.updateNode(point3d(1e9F, 0, 0)), nullptr);
  std::stringstream s(theirs.bytes());
  const std::unique_ptr<AbstractOcTree> read(AbstractOcTree::read(s));
  ASSERT_NE(dynamic_cast<CountingOcTree*>(read.get()), nullptr);
  EXPECT_TRUE(otBytes(*read) == theirs.bytes());
}

TEST(CountingOcTree, AnEmptyOneHasNoCenters) {
  octomap::point3d_list centers;
  CountingOcTree(0.1).getCentersMinHits(centers, 0);
  EXPECT_TRUE(centers.empty());
}

// --- files ---

TEST(Factory, KnowsAllTypes) {
  for (const char* id : {"OcTree", "ColorOcTree", "OcTreeStamped", "OcTreeBase"}) {
    const std::unique_ptr<AbstractOcTree> tree(AbstractOcTree::createTree(id, 0.25));
    ASSERT_NE(tree, nullptr) << id;
    EXPECT_EQ(tree->getTreeType(), id);
    EXPECT_EQ(tree->getResolution(), 0.25);
  }
  EXPECT_EQ(AbstractOcTree::createTree("NoSuchTree", 0.25), nullptr);
}

TEST(Factory, TruncatedColourFilesAreRefused) {
  ColorOcTree tree(0.1);
  tree.updateNode(OcTreeKey(1, 2, 3), true);
  const std::string whole = otBytes(tree);
  for (std::size_t cut = 1; cut < 60; ++cut) {
    std::istringstream s(whole.substr(0, whole.size() - cut));
    EXPECT_EQ(AbstractOcTree::read(s), nullptr) << cut;
  }
}

}  // namespace
}  // namespace rhmap
