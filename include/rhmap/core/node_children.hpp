// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "rhmap/core/piece_pool.hpp"

namespace rhmap {

/// What all nodes have in common: a name, under which they are handed about.
class AbstractOcTreeNode {};

/// The children of a node, of whatever type. Null where there is none.
class NodeChildren {
 public:
  NodeChildren() = default;
  /// Eight siblings at `first`, `stride` bytes apart, of which those in `mask` exist.
  NodeChildren(AbstractOcTreeNode* first, std::size_t stride, std::uint8_t mask)
      : first_(reinterpret_cast<char*>(first)), stride_(stride), mask_(mask) {}

  AbstractOcTreeNode* operator[](unsigned i) const {
    return has(i) ? reinterpret_cast<AbstractOcTreeNode*>(first_ + i * stride_) : nullptr;
  }
  bool has(unsigned i) const { return i < 8 && (mask_ >> i & 1) != 0; }
  bool empty() const { return mask_ == 0; }

 private:
  char* first_ = nullptr;
  std::size_t stride_ = 0;
  std::uint8_t mask_ = 0;
};

/// Slabs are the aligned pieces of memory that nodes live in. All of this size, so that any address inside one tells
/// where it begins.
inline constexpr std::size_t kSlabBytes = kPieceBytes;

/// What stands at the beginning of every slab.
struct SlabHeader {
  bool inner;         ///< its nodes may have children
  const void* store;  ///< the BlockStore that they belong to
  NodeChildren (*children)(const void* store, const void* node);

  /// Of the slab that holds this address; there must be one.
  static const SlabHeader* around(const void* address) {
    return reinterpret_cast<const SlabHeader*>(reinterpret_cast<std::uintptr_t>(address) & ~(kSlabBytes - 1));
  }
};

/// The slabs of all maps in this process, so that a node on its own (a copy on the stack, say) can be told from a node
/// in a map. From any thread.
void addSlab(const SlabHeader* slab);
void removeSlab(const SlabHeader* slab);
bool isInSlab(const void* address);

/// The children of the node that has this address inside it. A node that is in no map has none.
inline NodeChildren childrenOf(const void* address) {
  if (!isInSlab(address)) return {};
  const SlabHeader* slab = SlabHeader::around(address);
  return slab->inner ? slab->children(slab->store, address) : NodeChildren();
}

}  // namespace rhmap
