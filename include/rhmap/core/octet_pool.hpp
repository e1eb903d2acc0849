// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>
#include <vector>

#include "rhmap/core/block.hpp"
#include "rhmap/core/node_children.hpp"

namespace rhmap {

/// Memory for octets: eight nodes side by side at an address that stays until the octet is released.
///
/// Octets come from aligned slabs, so that a node's address tells its slab. Octets of inner nodes carry an owner (block
/// and number of the octet), which is what makes `getNodeChild(node*)` possible without a child pointer in every node.
/// Octets of depth-16 leaves have no children and hence no owner: 8 nodes and nothing else.
template <class NODE>
class OctetPool {
 public:
  /// Of a store whose nodes are asked for their children by `children`.
  explicit OctetPool(const void* store = nullptr, NodeChildren (*children)(const void*, const void*) = nullptr)
      : store_(store), children_(children) {}
  OctetPool(const OctetPool&) = delete;
  OctetPool& operator=(const OctetPool&) = delete;
  ~OctetPool() { clear(); }

  /// Raw memory for eight depth-16 leaves.
  OctetRef allocateLeaves() { return allocate(leaves_); }

  /// Raw memory for eight nodes that may have children, being octet `number` of `block`.
  OctetRef allocateInner(Block* block, int number) {
    const OctetRef ref = allocate(inner_);
    std::memset(static_cast<void*>(nodes(ref)), 0, kOctetBytes);  // Trunk compares octets whole
    owner(slabs_[ref >> kIndexBits], ref & kIndexMask) =
        reinterpret_cast<std::uintptr_t>(block) | static_cast<std::uintptr_t>(number);
    return ref;
  }

  /// Gives the memory back; the nodes must have been destroyed.
  void release(OctetRef ref) {
    Kind& kind = slabs_[ref >> kIndexBits]->inner ? inner_ : leaves_;
    std::memcpy(static_cast<void*>(nodes(ref)), &kind.free_list, sizeof kind.free_list);
    kind.free_list = ref;
  }

  NODE* nodes(OctetRef ref) const {
    return reinterpret_cast<NODE*>(reinterpret_cast<char*>(slabs_[ref >> kIndexBits]) + kHeaderBytes) +
           std::size_t{8} * (ref & kIndexMask);
  }

  /// Where a node of this pool sits, by an address inside the node; empty for a depth-16 leaf.
  static NodeRef locate(const void* node) {
    const SlabHeader* slab = SlabHeader::around(node);
    if (!slab->inner) return {};
    const char* first = reinterpret_cast<const char*>(slab) + kHeaderBytes;
    const auto index = static_cast<std::size_t>(static_cast<const char*>(node) - first) / sizeof(NODE);
    const std::uintptr_t tagged = owner(slab, index / 8);
    return {reinterpret_cast<Block*>(tagged & ~std::uintptr_t{127}), static_cast<int>((tagged & 127) * 8 + index % 8)};
  }

  /// Frees all slabs; the nodes must have been destroyed.
  void clear() {
    for (SlabHeader* slab : slabs_) {
      removeSlab(slab);
      ::operator delete (slab, std::align_val_t{kSlabBytes});
    }
    slabs_ = decltype(slabs_)();
    leaves_ = Kind{false};
    inner_ = Kind{true};
  }

  /// Bytes in use: what was ever handed out (released octets are kept for reuse).
  std::size_t memoryUsage() const {
    const auto used = [](const Kind& kind, std::size_t octet_bytes) {
      const std::size_t full = kind.slabs > 0 ? kind.slabs - 1 : 0;
      return (full * kind.capacity() + kind.next) * octet_bytes + kind.slabs * kHeaderBytes;
    };
    return used(leaves_, kOctetBytes) + used(inner_, kOctetBytes + sizeof(std::uintptr_t));
  }

 private:
  static constexpr std::size_t kOctetBytes = 8 * sizeof(NODE);
  static constexpr std::size_t kHeaderBytes = std::max<std::size_t>(64, alignof(NODE));
  static constexpr OctetRef kLeafCapacity = (kSlabBytes - kHeaderBytes) / kOctetBytes;
  static constexpr OctetRef kInnerCapacity = (kSlabBytes - kHeaderBytes) / (kOctetBytes + sizeof(std::uintptr_t));
  static constexpr int kIndexBits = std::bit_width(kLeafCapacity - 1);
  static constexpr OctetRef kIndexMask = (OctetRef{1} << kIndexBits) - 1;
  static constexpr OctetRef kNone = std::numeric_limits<OctetRef>::max();

  /// One of the two kinds of octets: its newest slab, filled up to `next`, and what was released.
  struct Kind {
    bool inner;
    OctetRef current = 0;
    OctetRef next = 0;
    std::size_t slabs = 0;
    OctetRef free_list = kNone;
    OctetRef capacity() const { return inner ? kInnerCapacity : kLeafCapacity; }
  };

  static_assert(kInnerCapacity >= 8, "a node type of many kilobytes: keep such data outside of the nodes");
  static_assert(sizeof(SlabHeader) <= kHeaderBytes);

  static std::uintptr_t& owner(const SlabHeader* slab, std::size_t index) {
    const std::size_t offset = (kHeaderBytes + kInnerCapacity * kOctetBytes + 7) / 8 * 8;
    static_assert((kHeaderBytes + kInnerCapacity * kOctetBytes + 7) / 8 * 8 + kInnerCapacity * sizeof(std::uintptr_t) <=
                  kSlabBytes);
    char* start = reinterpret_cast<char*>(const_cast<SlabHeader*>(slab));
    return reinterpret_cast<std::uintptr_t*>(start + offset)[index];
  }

  OctetRef allocate(Kind& kind) {
    if (kind.free_list != kNone) {
      const OctetRef ref = kind.free_list;
      std::memcpy(&kind.free_list, static_cast<const void*>(nodes(ref)), sizeof kind.free_list);
      return ref;
    }
    if (kind.slabs == 0 || kind.next == kind.capacity()) {
      if (slabs_.size() > (kNone >> kIndexBits) - 1) throw std::length_error("rhmap: more than 2^32 octets in one map");
      slabs_.reserve(slabs_.size() + 1);
      slabs_.push_back(newSlab(kind.inner));
      kind.current = static_cast<OctetRef>(slabs_.size() - 1);
      kind.next = 0;
      ++kind.slabs;
    }
    return kind.current << kIndexBits | kind.next++;
  }

  SlabHeader* newSlab(bool inner) {
    void* memory = ::operator new (kSlabBytes, std::align_val_t{kSlabBytes});
    auto* slab = new (memory) SlabHeader{inner, store_, children_};
    try {
      addSlab(slab);
    } catch (...) {
      ::operator delete (memory, std::align_val_t{kSlabBytes});
      throw;
    }
    return slab;
  }

  const void* store_;
  NodeChildren (*children_)(const void*, const void*);
  std::vector<SlabHeader*> slabs_;
  Kind leaves_{false};
  Kind inner_{true};
};

}  // namespace rhmap
