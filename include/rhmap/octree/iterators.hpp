// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <iterator>

#include "rhmap/core/leaf_walk.hpp"
#include "rhmap/core/region_lookahead.hpp"
#include "rhmap/octree/key_space.hpp"

namespace rhmap {

/// OctoMap's iterators without a stack: a node's place is enough to find the next one, depth first, children 0 ... 7.
/// Any structural change invalidates; changed values do not. `TREE` gives `store()` and `keySpace()`, `Wanted` says
/// which leaves of regions that are entered as a whole are.
template <class TREE, class Wanted = AllLeaves>
class OcTreeIteratorBase {
 public:
  using NodeType = typename TREE::NodeType;
  using iterator_category = std::forward_iterator_tag;
  using value_type = NodeType;
  using difference_type = std::ptrdiff_t;
  using pointer = NodeType*;
  using reference = NodeType&;

  /// An end iterator.
  OcTreeIteratorBase() = default;
  /// At the root; nodes at `max_depth` are not entered (0: the whole tree).
  OcTreeIteratorBase(const TREE* tree, unsigned max_depth)
      : tree_(tree), max_depth_(max_depth == 0 || max_depth > kTreeDepth ? kTreeDepth : max_depth) {
    if (tree_ != nullptr && tree_->store().root()) {
      moveTo(tree_->store().root());
    } else {
      *this = {};
    }
  }

  bool operator==(const OcTreeIteratorBase& other) const { return node_ == other.node_; }

  const NodeType* operator->() const { return node_; }
  NodeType* operator->() { return node_; }
  const NodeType& operator*() const { return *node_; }
  NodeType& operator*() { return *node_; }

  /// Centre of the node [m].
  [[gnu::always_inline]] point3d getCoordinate() const {
    const KeySpace& keys = tree_->keySpace();
    return at_.isCell() ? keys.keyToCoord(at_.corner()) : centreOf(at_, keys);
  }
  double getX() const { return tree_->keySpace().keyToCoord(getKey()[0], getDepth()); }
  double getY() const { return tree_->keySpace().keyToCoord(getKey()[1], getDepth()); }
  double getZ() const { return tree_->keySpace().keyToCoord(getKey()[2], getDepth()); }
  /// Edge length of the node [m].
  [[gnu::always_inline]] double getSize() const {
    const KeySpace& keys = tree_->keySpace();
    return at_.isCell() ? keys.resolution() : keys.nodeSize(getDepth());
  }
  unsigned getDepth() const { return at_.depth(); }
  /// Key of the node's centre.
  OcTreeKey getKey() const { return centreKey(at_.corner(), at_.depth()); }
  /// Smallest key in the node.
  OcTreeKey getIndexKey() const { return at_.corner(); }

 protected:
  static bool everything(NodeRef) { return true; }

  bool atLeaf() const { return getDepth() >= max_depth_ || !tree_->store().hasChildren(at_); }

  /// To the first accepted child; false, and no move, if there is none.
  template <class Accept>
  bool enter(Accept&& accept) {
    if (getDepth() >= max_depth_) return false;
    const NodeRef octet = tree_->store().childOctetOf(at_);
    if (!octet) return false;
    if (octet.slot == kTopOctet && octet.block->level() == kRegionLevel) prefetchRegionsAfter(tree_->store(), at_);
    return takeFirst(octet, octet.block->mask[octet.slot], accept);
  }

  /// To the next accepted node that is not below this one; to the end if there is none.
  template <class Accept>
  void passBy(Accept&& accept) {
    for (;;) {
      const NodeRef octet{at_.block, at_.slot >> 3};
      const unsigned later = octet.block->mask[octet.slot] & (0xfeU << at_.sibling());
      if (takeFirst(octet, later, accept)) return;
      at_ = BlockStore<NodeType>::parent(at_);
      if (!at_) break;
    }
    *this = {};
  }

  /// From a node at depth 13 into its region, to the first of the leaves wantedOf(region); false, and no move, if there
  /// is none.
  template <class WantedOf>
  bool enterRegion(WantedOf&& wantedOf) {
    if (at_.block->level() != kRegionLevel - 1 || at_.slot >= kCells || max_depth_ != kTreeDepth) return false;
    const NodeRef above = at_, octet = tree_->store().childOctetOf(at_);
    if (!octet) return false;
    prefetchRegionsAfter(tree_->store(), at_);
    at_.block = octet.block;
    walk_ = LeafWalk<Wanted>(*octet.block, wantedOf(*octet.block));
    if (nextInRegion()) return true;
    at_ = above;
    return false;
  }

  /// To the next leaf of the 64 cells that the walk is in; false if there is none any more.
  bool nextInOctant() {
    if (!walk_.hasMore()) return false;
    moveTo({at_.block, walk_.take()});
    if (node_ == nullptr) __builtin_unreachable();  // who compares with the end need not do it here
    return true;
  }

  /// To the next leaf of the region that was entered. If there is none any more: false, and passBy() goes on behind it.
  bool nextInRegion() { return walk_.findNext() && nextInOctant(); }

  void moveTo(NodeRef node) {
    at_ = node;
    node_ = tree_->store().node(node);
  }

  const TREE* tree_ = nullptr;
  NodeRef at_;
  NodeType* node_ = nullptr;  // null at the end
  LeafWalk<Wanted> walk_;     // in a region that was entered as a whole
  unsigned max_depth_ = 0;

 private:
  // Of the few that are no cells: out of line, and without the iterator's address (see OcTreeLeafIterator).
  [[gnu::noinline]] static point3d centreOf(NodeRef at, const KeySpace& keys) {
    return keys.keyToCoord(centreKey(at.corner(), at.depth()), at.depth());
  }

  template <class Accept>
  bool takeFirst(NodeRef octet, unsigned mask, Accept&& accept) {
    for (; mask != 0; mask &= mask - 1) {
      const NodeRef child{octet.block, octet.slot * 8 + std::countr_zero(mask)};
      if (!accept(child)) continue;
      moveTo(child);
      return true;
    }
    return false;
  }
};

/// Every node, parents before children.
template <class TREE>
class OcTreeTreeIterator : public OcTreeIteratorBase<TREE> {
  using Base = OcTreeIteratorBase<TREE>;

 public:
  OcTreeTreeIterator() = default;
  explicit OcTreeTreeIterator(const TREE* tree, unsigned max_depth = 0) : Base(tree, max_depth) {}

  OcTreeTreeIterator& operator++() {
    if (this->tree_ != nullptr && !this->enter(Base::everything)) this->passBy(Base::everything);
    return *this;
  }
  OcTreeTreeIterator operator++(int) {
    auto before = *this;
    ++*this;
    return before;
  }

  /// Childless, or at the depth limit.
  bool isLeaf() const { return this->atLeaf(); }
};

/// Leaves; with a depth limit also the inner nodes at that depth.
template <class TREE>
class OcTreeLeafIterator : public OcTreeIteratorBase<TREE> {
  using Base = OcTreeIteratorBase<TREE>;

 public:
  OcTreeLeafIterator() = default;
  explicit OcTreeLeafIterator(const TREE* tree, unsigned max_depth = 0) { *this = first(tree, max_depth); }

  [[gnu::always_inline]] OcTreeLeafIterator& operator++() {
    if (!this->nextInOctant()) [[unlikely]]
      *this = afterOctant(*this);
    return *this;
  }
  OcTreeLeafIterator operator++(int) {
    auto before = *this;
    ++*this;
    return before;
  }

 private:
  // Copies come and go here, so that nobody has the address of the one in a loop, which then can stay in registers.
  [[gnu::noinline]] static OcTreeLeafIterator first(const TREE* tree, unsigned max_depth) {
    OcTreeLeafIterator it;
    static_cast<Base&>(it) = Base(tree, max_depth);
    it.descend();
    return it;
  }
  [[gnu::noinline]] static OcTreeLeafIterator afterOctant(OcTreeLeafIterator it) {
    if (it.nextInRegion() || it.tree_ == nullptr) return it;
    it.passBy(Base::everything);
    it.descend();
    return it;
  }

  void descend() {
    if (this->tree_ == nullptr) return;
    while (!this->enterRegion([](const Block&) { return AllLeaves(); }) && this->enter(Base::everything)) {
    }
  }
};

/// Leaves that touch a box of keys, by touchesBox().
template <class TREE>
class OcTreeLeafBbxIterator : public OcTreeIteratorBase<TREE, LeavesInBox> {
  using Base = OcTreeIteratorBase<TREE, LeavesInBox>;

 public:
  OcTreeLeafBbxIterator() = default;
  OcTreeLeafBbxIterator(const TREE* tree, const OcTreeKey& min, const OcTreeKey& max, unsigned max_depth = 0)
      : Base(tree, max_depth), min_(min), max_(max) {
    descend();
  }
  /// Corners in metres; at the end at once if one is outside of the tree.
  OcTreeLeafBbxIterator(const TREE* tree, const point3d& min, const point3d& max, unsigned max_depth = 0)
      : Base(tree, max_depth) {
    if (this->tree_ == nullptr) return;
    if (!tree->keySpace().coordToKeyChecked(min, min_) || !tree->keySpace().coordToKeyChecked(max, max_)) {
      *this = {};
      return;
    }
    descend();
  }

  OcTreeLeafBbxIterator& operator++() {
    if (this->nextInRegion() || this->tree_ == nullptr) return *this;
    this->passBy(overlap());
    descend();
    return *this;
  }
  OcTreeLeafBbxIterator operator++(int) {
    auto before = *this;
    ++*this;
    return before;
  }

 private:
  auto overlap() const {
    return [this](NodeRef child) {
      const OcTreeKey corner = child.corner();
      const int edge = 1 << (kTreeDepth - child.depth());
      for (unsigned i = 0; i < 3; ++i)
        if (!touchesBox(corner[i], edge, min_[i], max_[i])) return false;
      return true;
    };
  }

  /// To the next leaf from here on: an inner node without an accepted child is passed by.
  void descend() {
    const auto inBox = [this](const Block& region) { return LeavesInBox(region.corner(), min_, max_); };
    while (this->tree_ != nullptr && !this->enterRegion(inBox) && !this->atLeaf())
      if (!this->enter(overlap())) this->passBy(overlap());
  }

  OcTreeKey min_{0, 0, 0};
  OcTreeKey max_{0, 0, 0};
};

}  // namespace rhmap
