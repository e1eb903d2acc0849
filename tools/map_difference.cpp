// SPDX-License-Identifier: BSD-3-Clause
#include "map_difference.hpp"

namespace rhmap::tools {
namespace {

class Comparer {
 public:
  Comparer(const OcTree& a, const OcTree& b) : a_(a), b_(b) {}

  /// Goes down both trees together; a leaf stands for all cells below it, null for unknown ones.
  void compare(const OcTreeNode* a, const OcTreeNode* b, unsigned depth) {
    const bool deeper_a = a != nullptr && a_.nodeHasChildren(a), deeper_b = b != nullptr && b_.nodeHasChildren(b);
    if (!deeper_a && !deeper_b) return count(a, b, std::uint64_t{1} << 3 * (kTreeDepth - depth));
    for (unsigned i = 0; i < 8; ++i)
      compare(deeper_a ? childOf(a_, a, i) : a, deeper_b ? childOf(b_, b, i) : b, depth + 1);
  }

  const MapDifference& result() const { return result_; }

 private:
  static const OcTreeNode* childOf(const OcTree& tree, const OcTreeNode* node, unsigned i) {
    return tree.nodeChildExists(node, i) ? tree.getNodeChild(node, i) : nullptr;
  }

  void count(const OcTreeNode* a, const OcTreeNode* b, std::uint64_t cells) {
    if (a == nullptr && b == nullptr) return;
    const bool both = a != nullptr && b != nullptr;
    result_.known += cells;
    if (!both || a_.isNodeOccupied(a) != b_.isNodeOccupied(b)) result_.states += cells;
    if (!both || a->getLogOdds() != b->getLogOdds()) result_.values += cells;
  }

  const OcTree& a_;
  const OcTree& b_;
  MapDifference result_;
};

}  // namespace

MapDifference differenceOf(const OcTree& a, const OcTree& b) {
  Comparer comparer(a, b);
  comparer.compare(a.getRoot(), b.getRoot(), 0);
  return comparer.result();
}

}  // namespace rhmap::tools
