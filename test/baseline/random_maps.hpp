// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../octree/oracle.hpp"  // first: it silences OctoMap's templates

#include <algorithm>
#include <memory>
#include <random>
#include <sstream>

#include "../octree/random_cells.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap::test {

/// The same random calls on a map and on stock OctoMap, all those that change nodes, sensor model or resolution.
class RandomMaps : public RandomCells {
 public:
  explicit RandomMaps(unsigned seed) : RandomCells(seed) {}

  OcTree& ours() { return *ours_; }
  OctomapOracle& theirs() { return *theirs_; }
  /// True once after values were written through node pointers, which a map cannot notice.
  bool wroteByPointer() { return std::exchange(wrote_by_pointer_, false); }

  point3d point() { return ours_->keyToCoord(key()); }

  void step() {
    switch (below(16)) {
      case 0:
        return fillCube();
      case 1:
        return insertScan();
      case 2:
        return changeStructure();
      case 3:
        return changeByPointer();
      case 4:
        return changeEverything();
      case 5: {
        const OcTreeKey k = key();
        return both([&](auto& t) { t.deleteNode(k); });
      }
      case 6: {
        const OcTreeKey k = key();
        const auto depth = static_cast<unsigned>(10 + below(7));
        return both([&](auto& t) {  // OctoMap leaks what is below an inner node
          if (const auto* node = t.search(k, depth); node != nullptr && !t.nodeHasChildren(node))
            t.deleteNode(k, depth);
        });
      }
      default:
        return changeCell();
    }
  }

 private:
  template <class F>
  void both(F&& call) {
    call(*ours_);
    call(*theirs_);
  }

  void changeCell() {
    const OcTreeKey k = key();
    const bool hit = below(2) == 0, lazy = below(5) == 0;
    const float value = below(5) == 0 ? (hit ? 0.0F : -0.0F) : static_cast<float>(real(-4, 4));
    switch (below(3)) {
      case 0:
        return both([&](auto& t) { t.setNodeValue(k, value, lazy); });
      case 1:
        return both([&](auto& t) { t.updateNode(k, value, lazy); });
      default:
        return both([&](auto& t) { t.updateNode(k, hit, lazy); });
    }
  }

  void fillCube() {  // so that things prune
    const int size = 1 << below(5);
    const bool hit = below(2) == 0, lazy = below(5) == 0;
    OcTreeKey corner = key();
    for (unsigned i = 0; i < 3; ++i) corner[i] = static_cast<key_type>(corner[i] & ~(size - 1));
    both([&](auto& t) {
      for (int i = 0; i < size * size * size; ++i) {
        const OcTreeKey cell(static_cast<key_type>(corner[0] + i % size),
                             static_cast<key_type>(corner[1] + i / size % size),
                             static_cast<key_type>(corner[2] + i / size / size));
        t.setNodeValue(cell, hit ? 1.0F : -1.0F, lazy);
      }
    });
  }

  void insertScan() {
    octomap::Pointcloud scan;
    for (int i = below(30); i >= 0; --i) scan.push_back(point());
    const point3d origin = point();
    const bool lazy = below(3) == 0, rays = below(4) == 0;
    both([&](auto& t) {
      if (rays) {
        t.insertPointCloudRays(scan, origin, -1, lazy);
      } else {
        t.insertPointCloud(scan, origin, -1, lazy);
      }
    });
  }

  void changeStructure() {
    const OcTreeKey k = key();
    const auto depth = static_cast<unsigned>(10 + below(6));
    const auto child = static_cast<unsigned>(below(8));
    const auto value = static_cast<float>(real(-3, 3));
    const int what = below(4);
    both([&](auto& t) {
      auto* node = t.search(k, depth);
      if (node == nullptr) return;
      const bool inner = t.nodeHasChildren(node);
      // A leaf from search() may be one of depth 16, which has no children.
      if (!inner && t.search(k, 15) == nullptr) return;
      if (what == 0) {
        t.pruneNode(node);
      } else if (what == 1 && !inner) {
        t.expandNode(node);
      } else if (what == 2 && !t.nodeChildExists(node, child)) {
        t.createNodeChild(node, child)->setLogOdds(value);
      } else if (what == 3 && t.nodeChildExists(node, child) && !t.nodeHasChildren(t.getNodeChild(node, child))) {
        t.deleteNodeChild(node, child);
      }
    });
  }

  void changeByPointer() {
    const OcTreeKey k = key();
    const auto depth = static_cast<unsigned>(10 + below(7));
    const auto value = static_cast<float>(real(-3, 3));
    wrote_by_pointer_ = true;
    both([&](auto& t) {
      if (auto* node = t.search(k, depth)) node->setLogOdds(value);
    });
  }

  void changeEverything() {
    const double p = real(0.5, 0.99);
    switch (below(14)) {
      case 0:
        return both([&](auto& t) { t.setProbHit(p); });
      case 1:
        return both([&](auto& t) { t.setProbMiss(1 - p); });
      case 2:
        return both([&](auto& t) { t.setClampingThresMin((1 - p) / 2); });
      case 3:
        return both([&](auto& t) { t.setClampingThresMax(p); });
      case 4:
        return both([&](auto& t) { t.setOccupancyThres(p); });
      case 5:
        return both([&](auto& t) { t.setResolution(p); });
      case 6:
      case 7:
        return both([&](auto& t) { t.prune(); });
      case 8:
      case 9:
        return both([&](auto& t) { t.updateInnerOccupancy(); });
      case 10:
        if (below(4) == 0) both([&](auto& t) { t.toMaxLikelihood(); });
        return;
      case 11:
        return swapOrClear();
      case 12:
        return readBack();
      default:
        // Only where no leaf is so large that memory would not do.
        for (auto it = ours_->begin(), end = ours_->end(); it != end; ++it)
          if (it.getDepth() < 13) return;
        if (ours_->size() > 1 && below(8) == 0) both([](auto& t) { t.expand(); });
    }
  }

  void swapOrClear() {
    if (below(4) == 0) return both([](auto& t) { t.clear(); });
    OcTree ours(ours_->getResolution());
    OctomapOracle theirs(theirs_->getResolution());
    ours.updateNode(base(), true);
    theirs.updateNode(base(), true);
    ours_->swapContent(ours);
    theirs_->swapContent(theirs);
    if (below(4) == 0) return;
    ours_->swapContent(ours);
    theirs_->swapContent(theirs);
  }

  void readBack() {
    if (ours_->size() == 0) return;  // OctoMap reads a root where there are no bytes
    const bool binary = below(4) == 0;
    both([&](auto& t) {
      std::stringstream s;
      if (binary) {
        t.writeBinary(s);
        t.readBinary(s);
      } else {
        t.writeData(s);
        t.clear();
        t.readData(s);
      }
    });
  }

  std::unique_ptr<OcTree> ours_ = std::make_unique<OcTree>(0.1);
  std::unique_ptr<OctomapOracle> theirs_ = std::make_unique<OctomapOracle>(0.1);
  bool wrote_by_pointer_ = false;
};

/// The sensor model, to the bit.
template <class Tree>
std::vector<float> model(const Tree& t) {
  return {t.getProbHitLog(), t.getProbMissLog(), t.getClampingThresMinLog(), t.getClampingThresMaxLog(),
          t.getOccupancyThresLog()};
}

/// The bounds as OctoMap gives and caches them.
template <class Tree>
std::vector<double> bounds(Tree& t) {
  std::vector<double> b(6);
  t.getMetricMin(b[0], b[1], b[2]);
  t.getMetricMax(b[3], b[4], b[5]);
  return b;
}

}  // namespace rhmap::test
