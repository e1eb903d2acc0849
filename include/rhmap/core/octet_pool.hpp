// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <mutex>
#include <new>
#include <span>
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
  static constexpr OctetRef kNone = std::numeric_limits<OctetRef>::max();

 public:
  /// Of a store whose nodes are asked for their children by `children`.
  explicit OctetPool(const void* store = nullptr, NodeChildren (*children)(const void*, const void*) = nullptr)
      : store_(store), children_(children) {}
  OctetPool(const OctetPool&) = delete;
  OctetPool& operator=(const OctetPool&) = delete;
  ~OctetPool() { clear(); }

  /// Octets of one kind that are there to be handed out: the rest of a slab, and what was released.
  struct Stock {
    OctetRef next = 0;
    OctetRef left = 0;
    OctetRef released = kNone;
  };
  /// Where one thread takes octets from and puts them back. Several threads may work with one pool, each with a source
  /// of its own, after reserve().
  struct alignas(64) Source {
    Stock leaves, inner;
  };

  /// Sources for this number of threads, which will not take more than `octets` together. The first is the one for work
  /// in a single thread.
  std::span<Source> reserve(std::size_t threads, std::size_t octets) {
    if (sources_.size() < threads) sources_.resize(threads);
    slabs_.reserve(slabs_.size() + 2 * threads + octets / kInnerCapacity + 1);  // so that it stays where it is
    return {sources_.data(), threads};
  }
  Source& source() { return sources_.front(); }

  /// Raw memory for eight depth-16 leaves.
  OctetRef allocateLeaves(Source& source) { return allocate(source.leaves, false); }
  OctetRef allocateLeaves() { return allocateLeaves(source()); }

  /// Raw memory for eight nodes that may have children, being octet `number` of `block`.
  OctetRef allocateInner(Source& source, Block* block, int number) {
    const OctetRef ref = allocate(source.inner, true);
    std::memset(static_cast<void*>(nodes(ref)), 0, kOctetBytes);  // Trunk compares octets whole
    owner(slabs_[ref >> kIndexBits], ref & kIndexMask) =
        reinterpret_cast<std::uintptr_t>(block) | static_cast<std::uintptr_t>(number);
    return ref;
  }
  OctetRef allocateInner(Block* block, int number) { return allocateInner(source(), block, number); }

  /// Gives the memory back; the nodes must have been destroyed.
  void release(Source& source, OctetRef ref) {
    Stock& stock = slabs_[ref >> kIndexBits]->inner ? source.inner : source.leaves;
    std::memcpy(static_cast<void*>(nodes(ref)), &stock.released, sizeof stock.released);
    stock.released = ref;
  }
  void release(OctetRef ref) { release(source(), ref); }

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
      freeLargePiece(slab);
    }
    slabs_ = decltype(slabs_)();
    sources_ = std::vector<Source>(1);
  }

  /// Bytes in use: what was ever handed out (released octets are kept for reuse).
  std::size_t memoryUsage() const {
    std::size_t bytes = 0;
    for (const SlabHeader* slab : slabs_)
      bytes += kHeaderBytes + (slab->inner ? kInnerCapacity * kInnerBytes : kLeafCapacity * kOctetBytes);
    for (const Source& source : sources_) bytes -= source.leaves.left * kOctetBytes + source.inner.left * kInnerBytes;
    return bytes;
  }

 private:
  static constexpr std::size_t kOctetBytes = 8 * sizeof(NODE);
  static constexpr std::size_t kHeaderBytes = std::max<std::size_t>(64, alignof(NODE));
  static constexpr OctetRef kLeafCapacity = (kSlabBytes - kHeaderBytes) / kOctetBytes;
  static constexpr std::size_t kInnerBytes = kOctetBytes + sizeof(std::uintptr_t);
  static constexpr OctetRef kInnerCapacity = (kSlabBytes - kHeaderBytes) / kInnerBytes;
  static constexpr int kIndexBits = std::bit_width(kLeafCapacity - 1);
  static constexpr OctetRef kIndexMask = (OctetRef{1} << kIndexBits) - 1;

  static_assert(kInnerCapacity >= 8, "a node type of many kilobytes: keep such data outside of the nodes");
  static_assert(sizeof(SlabHeader) <= kHeaderBytes);

  static std::uintptr_t& owner(const SlabHeader* slab, std::size_t index) {
    const std::size_t offset = (kHeaderBytes + kInnerCapacity * kOctetBytes + 7) / 8 * 8;
    static_assert((kHeaderBytes + kInnerCapacity * kOctetBytes + 7) / 8 * 8 + kInnerCapacity * sizeof(std::uintptr_t) <=
                  kSlabBytes);
    char* start = reinterpret_cast<char*>(const_cast<SlabHeader*>(slab));
    return reinterpret_cast<std::uintptr_t*>(start + offset)[index];
  }

  OctetRef allocate(Stock& stock, bool inner) {
    if (stock.released != kNone) {
      const OctetRef ref = stock.released;
      std::memcpy(&stock.released, static_cast<const void*>(nodes(ref)), sizeof stock.released);
      return ref;
    }
    if (stock.left == 0) refill(stock, inner);
    --stock.left;
    return stock.next++;
  }

  void refill(Stock& stock, bool inner) {
    const std::lock_guard lock(mutex_);  // once for many thousands of octets
    if (slabs_.size() > (kNone >> kIndexBits) - 1) throw std::length_error("rhmap: more than 2^32 octets in one map");
    slabs_.reserve(slabs_.size() + 1);
    slabs_.push_back(newSlab(inner));
    stock.next = static_cast<OctetRef>(slabs_.size() - 1) << kIndexBits;
    stock.left = inner ? kInnerCapacity : kLeafCapacity;
  }

  SlabHeader* newSlab(bool inner) {
    void* memory = allocateLargePiece(slabs_.size() >= 2);  // small maps stay small
    if (slabs_.size() == 2)
      for (SlabHeader* slab : slabs_) makeLargePage(slab);
    auto* slab = new (memory) SlabHeader{inner, store_, children_};
    try {
      addSlab(slab);
    } catch (...) {
      freeLargePiece(memory);
      throw;
    }
    return slab;
  }

  const void* store_;
  NodeChildren (*children_)(const void*, const void*);
  std::vector<SlabHeader*> slabs_;
  std::vector<Source> sources_ = std::vector<Source>(1);
  std::mutex mutex_;
};

}  // namespace rhmap
