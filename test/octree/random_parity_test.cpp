// SPDX-License-Identifier: BSD-3-Clause
// The same random calls on rhmap and on stock OctoMap: the same answers, and at the end the same bytes.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "oracle.hpp"
#include "random_cells.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {
namespace {

using test::btBytes;
using test::OctomapOracle;
using test::otBytes;

/// One call, with its random arguments drawn before, so that both trees get the same. The string is the answer.
template <class Tree>
std::string answer(const Tree&, bool value) {
  return value ? "true" : "false";
}
template <class Tree, class NODE>
std::string answer(const Tree& tree, NODE* node) {
  if (node == nullptr) return "null";
  std::string text = std::to_string(node->getLogOdds());
  if (!tree.nodeHasChildren(node)) text += " leaf";
  for (unsigned i = 0; i < 8; ++i)
    if (tree.nodeChildExists(node, i)) text += " " + std::to_string(tree.getNodeChild(node, i)->getLogOdds());
  return text;
}

template <class Iterator>
void describe(std::string& text, Iterator it, Iterator end) {
  for (; it != end; ++it) {
    const OcTreeKey key = it.getKey();
    const OcTreeKey index = it.getIndexKey();
    text += std::to_string(it.getDepth()) + ":" + std::to_string(key[0]) + "," + std::to_string(key[1]) + "," +
            std::to_string(key[2]) + "/" + std::to_string(index[0]) + "=" + std::to_string(it->getLogOdds()) + "@" +
            std::to_string(it.getX()) + "," + std::to_string(it.getCoordinate().z()) + "+" +
            std::to_string(it.getSize()) + "\n";
  }
}

template <class Tree>
std::map<std::vector<int>, bool> changedKeys(const Tree& tree) {
  std::map<std::vector<int>, bool> keys;
  for (auto it = tree.changedKeysBegin(); it != tree.changedKeysEnd(); ++it)
    keys[{it->first[0], it->first[1], it->first[2]}] = it->second;
  return keys;
}

class RandomParity : public testing::TestWithParam<unsigned>, protected test::RandomCells {
 protected:
  explicit RandomParity()
      : RandomCells(GetParam()),
        resolution_(GetParam() % 3 == 0   ? 0.05
                    : GetParam() % 3 == 1 ? 0.1
                                          : 0.37) {
    ours_ = std::make_unique<OcTree>(resolution_);
    theirs_ = std::make_unique<OctomapOracle>(resolution_);
  }

  point3d point() {
    const OcTreeKey k = key();
    point3d p = ours_->keyToCoord(k);
    for (unsigned i = 0; i < 3; ++i) p(i) += static_cast<float>(real(-0.6, 0.6) * resolution_);
    return p;
  }

  /// The same call on both; the same answer.
  template <class F>
  void both(const std::string& name, F&& call) {
    last_ = name;
    const auto run = [&](auto& tree) -> std::string {
      if constexpr (std::is_void_v<decltype(call(tree))>) {
        call(tree);
        return "";
      } else {
        return answer(tree, call(tree));
      }
    };
    ASSERT_EQ(run(*ours_), run(*theirs_)) << name;
    ASSERT_EQ(ours_->size(), theirs_->size()) << name;
  }

  void step();
  void insert();
  void parameters();
  void structure();
  void files();

  void expectSameBytes() {
    ASSERT_TRUE(otBytes(*ours_) == otBytes(*theirs_)) << "the .ot bytes differ after " << last_;
    ASSERT_TRUE(btBytes(*ours_) == btBytes(*theirs_)) << "the .bt bytes differ after " << last_;
  }
  void expectSameEverywhere();

  double resolution_;
  std::unique_ptr<OcTree> ours_;
  std::unique_ptr<OctomapOracle> theirs_;
  std::string last_;
};

void RandomParity::insert() {
  const bool lazy = below(4) == 0, discretize = below(4) == 0;
  const double max_range = below(2) == 0 ? -1.0 : below(6) == 0 ? 0.0 : real(0.5, 20) * resolution_;
  octomap::Pointcloud scan;
  for (int i = below(30); i >= 0; --i) {
    const point3d p = point();
    OcTreeKey inside;
    // Discretizing wraps a point outside around to the far side: a ray of more keys than OctoMap's buffer holds.
    if (!discretize || ours_->coordToKeyChecked(p, inside)) scan.push_back(p);
  }
  const point3d origin = below(20) == 0 ? point3d(1e7F, 0, 0) : point();
  switch (below(5)) {
    case 0:
      return both("insertPointCloudRays", [&](auto& t) { t.insertPointCloudRays(scan, origin, max_range, lazy); });
    case 1: {
      const point3d end = point();
      return both("insertRay", [&](auto& t) { return t.insertRay(origin, end, max_range, lazy); });
    }
    case 2: {
      const octomap::pose6d pose(point(), octomath::Quaternion(real(-3, 3), real(-3, 3), real(-3, 3)));
      octomap::Pointcloud local = scan;
      local.transform(pose.inv());
      const octomap::ScanNode node(new octomap::Pointcloud(local), pose, 0);
      return both("insertPointCloud(ScanNode)",
                  [&](auto& t) { t.insertPointCloud(node, max_range, lazy, discretize); });
    }
    case 3: {
      octomap::KeySet free[2], occupied[2];
      free[0].insert(key()), occupied[0].insert(key());
      free[1] = free[0], occupied[1] = occupied[0];
      if (discretize) {
        ours_->computeDiscreteUpdate(scan, origin, free[0], occupied[0], max_range);
        theirs_->computeDiscreteUpdate(scan, origin, free[1], occupied[1], max_range);
      } else {
        ours_->computeUpdate(scan, origin, free[0], occupied[0], max_range);
        theirs_->computeUpdate(scan, origin, free[1], occupied[1], max_range);
      }
      ASSERT_EQ(free[0].size(), free[1].size());
      ASSERT_EQ(occupied[0].size(), occupied[1].size());
      for (const auto& k : free[0]) ASSERT_TRUE(free[1].count(k));
      for (const auto& k : occupied[0]) ASSERT_TRUE(occupied[1].count(k));
      return;
    }
    default:
      return both("insertPointCloud", [&](auto& t) { t.insertPointCloud(scan, origin, max_range, lazy, discretize); });
  }
}

void RandomParity::parameters() {
  const double p = real(0.5, 0.99);
  const bool on = below(2) == 0;
  const point3d a = point(), b = point();
  switch (below(9)) {
    case 0:
      return both("setProbHit", [&](auto& t) { t.setProbHit(p); });
    case 1:
      return both("setProbMiss", [&](auto& t) { t.setProbMiss(1 - p); });
    case 2:
      return both("setClampingThresMin", [&](auto& t) { t.setClampingThresMin((1 - p) / 2); });
    case 3:
      return both("setClampingThresMax", [&](auto& t) { t.setClampingThresMax(p); });
    case 4:
      return both("setOccupancyThres", [&](auto& t) { t.setOccupancyThres(on ? 0.5 : p); });
    case 5:
      return both("enableChangeDetection", [&](auto& t) { t.enableChangeDetection(on); });
    case 6:
      return both("resetChangeDetection", [&](auto& t) { t.resetChangeDetection(); });
    case 7:
      return both("useBBXLimit", [&](auto& t) { t.useBBXLimit(on); });
    default:
      return both("setBBX", [&](auto& t) {
        t.setBBXMin(point3d(std::min(a.x(), b.x()), std::min(a.y(), b.y()), std::min(a.z(), b.z())));
        t.setBBXMax(point3d(std::max(a.x(), b.x()), std::max(a.y(), b.y()), std::max(a.z(), b.z())));
      });
  }
}

void RandomParity::structure() {
  const OcTreeKey k = key();
  const auto depth = static_cast<unsigned>(10 + below(7));
  const auto child = static_cast<unsigned>(below(8));
  const auto value = static_cast<float>(real(-3, 3));
  switch (below(10)) {
    case 0:
      return both("prune", [](auto& t) { t.prune(); });
    case 1:
      return both("updateInnerOccupancy", [](auto& t) { t.updateInnerOccupancy(); });
    case 2:
      return both("pruneNode", [&](auto& t) {
        auto* node = t.search(k, depth);
        return node != nullptr && t.pruneNode(node);
      });
    case 3:
      return both("expandNode", [&](auto& t) {
        auto* node = t.search(k, depth);
        // Never below depth 16, which OctoMap does not check.
        if (node == nullptr || t.nodeHasChildren(node) || t.search(k, 15) != t.search(k, 16)) return false;
        t.expandNode(node);
        return true;
      });
    case 4:
      return both("createNodeChild", [&](auto& t) {
        auto* node = t.search(k, std::min(depth, 15U));
        if (node == nullptr || !t.nodeHasChildren(node) || t.nodeChildExists(node, child)) return false;
        t.createNodeChild(node, child)->setLogOdds(value);
        return true;
      });
    case 5:
      return both("deleteNodeChild", [&](auto& t) {
        auto* node = t.search(k, std::min(depth, 15U));
        if (node == nullptr || !t.nodeChildExists(node, child)) return false;
        if (t.nodeHasChildren(t.getNodeChild(node, child))) return false;  // OctoMap would leak what is below
        int children = 0;
        for (unsigned i = 0; i < 8; ++i) children += t.nodeChildExists(node, i);
        if (children == 1) return false;
        t.deleteNodeChild(node, child);
        return true;
      });
    case 6:
      return both("setLogOdds by pointer", [&](auto& t) {
        auto* node = t.search(k, depth);
        if (node != nullptr) node->setLogOdds(value);
      });
    case 7:
      return both("isNodeCollapsible", [&](auto& t) {
        const auto* node = t.search(k, depth);
        return node != nullptr && t.isNodeCollapsible(node);
      });
    case 8:
      if (below(10) == 0) both("toMaxLikelihood", [](auto& t) { t.toMaxLikelihood(); });
      return;
    default:
      if (below(20) == 0 && ours_->size() > 1) {  // only where no leaf is so large that memory would not do
        for (auto it = ours_->begin(), end = ours_->end(); it != end; ++it)
          if (it.getDepth() < 13) return;
        both("expand", [](auto& t) { t.expand(); });
      }
  }
}

void RandomParity::files() {
  switch (below(5)) {
    case 0: {
      last_ = "copy";
      auto ours = std::make_unique<OcTree>(*ours_);
      ASSERT_TRUE(*ours == *ours_);
      ours_ = std::move(ours);
      return;  // OctoMap's copies are left alone: they are made of other nodes
    }
    case 1: {
      if (ours_->size() == 0) return;  // OctoMap reads a root where there are no bytes
      both("write + read data", [&](auto& t) {
        std::stringstream s;
        t.writeData(s);
        const std::size_t size = t.size();
        t.clear();
        t.readData(s);
        return size == t.size();
      });
      return;
    }
    case 2:
      if (below(4) != 0) return;
      return both("writeBinary + readBinary", [](auto& t) {
        std::stringstream s;
        t.writeBinary(s);
        return t.readBinary(s);
      });
    case 3: {
      OcTree other(resolution_);
      OctomapOracle other_theirs(resolution_);
      other.updateNode(base(), true);
      other_theirs.updateNode(base(), true);
      ours_->swapContent(other);
      theirs_->swapContent(other_theirs);
      if (below(4) != 0) {
        ours_->swapContent(other);
        theirs_->swapContent(other_theirs);
      }
      last_ = "swapContent";
      return;
    }
    default:
      if (below(10) == 0) both("clear", [](auto& t) { t.clear(); });
  }
}

void RandomParity::step() {
  const OcTreeKey k = key();
  const point3d p = point();
  const bool hit = below(2) == 0, lazy = below(5) == 0;
  const float value = below(5) == 0 ? 0.0F : static_cast<float>(real(-4, 4));
  const int what = below(100);
  if (what < 12) return both("updateNode(key, bool)", [&](auto& t) { return t.updateNode(k, hit, lazy); });
  if (what < 20) return both("updateNode(key, float)", [&](auto& t) { return t.updateNode(k, value, lazy); });
  if (what < 24) return both("updateNode(point, bool)", [&](auto& t) { return t.updateNode(p, hit, lazy); });
  if (what < 26)
    return both("updateNode(x, y, z, float)", [&](auto& t) { return t.updateNode(p.x(), p.y(), p.z(), value, lazy); });
  if (what < 34) return both("setNodeValue(key)", [&](auto& t) { return t.setNodeValue(k, value, lazy); });
  if (what < 36) return both("setNodeValue(point)", [&](auto& t) { return t.setNodeValue(p, value, lazy); });
  if (what < 46) {  // a cube, so that things prune
    const int size = 1 << below(5);
    OcTreeKey corner = k;
    for (unsigned i = 0; i < 3; ++i) corner[i] = static_cast<key_type>(corner[i] & ~(size - 1));
    both("fill a cube", [&](auto& t) {
      for (int i = 0; i < size * size * size; ++i) {
        const OcTreeKey cell(static_cast<key_type>(corner[0] + i % size),
                             static_cast<key_type>(corner[1] + i / size % size),
                             static_cast<key_type>(corner[2] + i / size / size));
        if (value > 2) {
          t.setNodeValue(cell, value, lazy);
        } else {
          t.updateNode(cell, hit, lazy);
        }
      }
    });
    return;
  }
  if (what < 54) return both("deleteNode(key)", [&](auto& t) { return t.deleteNode(k); });
  if (what < 56) return both("deleteNode(point)", [&](auto& t) { return t.deleteNode(p); });
  if (what < 58)
    return both("deleteNode(key, depth)", [&](auto& t) {
      const auto* node = t.search(k, 14);
      // OctoMap leaks what is below an inner node, and counts it on: see ContractTest.
      return node != nullptr && !t.nodeHasChildren(node) && t.deleteNode(k, 14);
    });
  if (what < 72) return insert();
  if (what < 80) return parameters();
  if (what < 90) return structure();
  if (what < 93) return files();
  const auto depth = static_cast<unsigned>(below(17));
  const point3d direction(static_cast<float>(below(5) - 2), static_cast<float>(real(-1, 1)),
                          static_cast<float>(below(3) - 1));
  const bool ignore = below(2) == 0;
  const double range = real(0.1, 50) * resolution_;
  both("search", [&](auto& t) { return t.search(k, depth); });
  both("castRay", [&](auto& t) {
    point3d end(7, 7, 7);
    const bool found = t.castRay(p, direction, end, ignore, range);
    t.updateNode(k, false);
    return std::abs(end.x()) < 1e6 && t.search(end) != nullptr ? found : !found;
  });
}

void RandomParity::expectSameEverywhere() {
  expectSameBytes();
  ASSERT_EQ(changedKeys(*ours_), changedKeys(*theirs_));
  ASSERT_EQ(ours_->getNumLeafNodes(), theirs_->getNumLeafNodes());
  ASSERT_EQ(ours_->calcNumNodes(), theirs_->calcNumNodes());
  ASSERT_EQ(ours_->memoryFullGrid(), theirs_->memoryFullGrid());
  const auto bounds = [](auto& tree) {
    std::array<double, 9> b;
    tree.getMetricMin(b[0], b[1], b[2]);
    tree.getMetricMax(b[3], b[4], b[5]);
    tree.getMetricSize(b[6], b[7], b[8]);
    return b;
  };
  ASSERT_EQ(bounds(std::as_const(*ours_)), bounds(std::as_const(*theirs_)));
  ASSERT_EQ(bounds(*ours_), bounds(*theirs_));
  ASSERT_EQ(bounds(std::as_const(*ours_)), bounds(std::as_const(*theirs_))) << "once they are cached";
  const OcTreeKey k1 = key(), k2 = key();
  const OcTreeKey low(std::min(k1[0], k2[0]), std::min(k1[1], k2[1]), std::min(k1[2], k2[2]));
  const OcTreeKey high(std::max(k1[0], k2[0]), std::max(k1[1], k2[1]), std::max(k1[2], k2[2]));
  for (unsigned char depth = 0; depth <= 16; ++depth) {
    std::string a, b;
    describe(a, ours_->begin(depth), ours_->end());
    describe(b, theirs_->begin(depth), theirs_->end());
    describe(a, ours_->begin_tree(depth), ours_->end_tree());
    describe(b, theirs_->begin_tree(depth), theirs_->end_tree());
    describe(a, ours_->begin_leafs_bbx(low, high, depth), ours_->end_leafs_bbx());
    describe(b, theirs_->begin_leafs_bbx(low, high, depth), theirs_->end_leafs_bbx());
    ASSERT_TRUE(a == b) << "iteration to depth " << int{depth} << " differs";
  }
  for (int i = 0; i < 200; ++i) {
    const OcTreeKey k = key();
    for (unsigned depth = 0; depth <= 16; ++depth)
      ASSERT_EQ(answer(*ours_, ours_->search(k, depth)), answer(*theirs_, theirs_->search(k, depth)));
    const point3d from = point();
    const point3d direction(static_cast<float>(real(-1, 1)), static_cast<float>(real(-1, 1)),
                            static_cast<float>(real(-1, 1)));
    point3d end_a(1, 2, 3), end_b(1, 2, 3);
    const double range = i % 2 == 0 ? -1.0 : 30 * resolution_;
    const bool ignore = range > 0;
    ASSERT_EQ(ours_->castRay(from, direction, end_a, ignore, range),
              theirs_->castRay(from, direction, end_b, ignore, range));
    ASSERT_EQ(end_a, end_b);
  }
}

TEST_P(RandomParity, TheSameCallsGiveTheSameAnswersAndTheSameBytes) {
  for (int i = 0; i < 1500; ++i) {
    ASSERT_NO_FATAL_FAILURE(step()) << "call " << i;
    if (i < 50 || i % 25 == 0) {
      ASSERT_NO_FATAL_FAILURE(expectSameBytes()) << "call " << i;
    }
  }
  ASSERT_NO_FATAL_FAILURE(expectSameEverywhere());
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomParity, testing::Range(1U, 61U));

}  // namespace
}  // namespace rhmap
