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
///
/// A block has no room for large numbers of its octets. So blocks belong to districts, in the order in which they are
/// made, and octets are numbered among those of a district's blocks. Most maps have one.
template <class NODE>
class OctetPool {
  static constexpr OctetRef kNone = std::numeric_limits<OctetRef>::max();

 public:
  /// Of a store whose nodes are asked for their children by `children`. In pieces of a pool that outlives the octets.
  explicit OctetPool(PiecePool& pieces, const void* store = nullptr,
                     NodeChildren (*children)(const void*, const void*) = nullptr)
      : pieces_(&pieces), store_(store), children_(children) {}
  OctetPool(const OctetPool&) = delete;
  OctetPool& operator=(const OctetPool&) = delete;
  ~OctetPool() { clear(); }

  /// Octets of one kind that are there to be handed out: the rest of a slab, and what was released.
  struct Stock {
    OctetRef next = 0;
    OctetRef left = 0;
    OctetRef released = kNone;
  };
  /// Those of a district.
  struct Stocks {
    Stock leaves, inner;
  };
  /// Where one thread takes octets from and puts them back. Several threads may work with one pool, each with a source
  /// of its own, after reserve().
  struct alignas(64) Source {
    std::vector<Stocks> districts;
  };

  /// Sources for this number of threads, which will not take more than `octets` together, for blocks that are in the
  /// pool. The first is the one for work in a single thread.
  std::span<Source> reserve(std::size_t threads, std::size_t octets) {
    if (sources_.size() < threads) sources_.resize(threads);
    for (Source& source : sources_) source.districts.resize(districts_.size());
    slabs_.reserve(slabs_.size() + 2 * threads + octets / kInnerCapacity + 1);  // so that it stays where it is
    return {sources_.data(), threads};
  }
  Source& source() { return sources_.front(); }

  /// Takes a block up into a district, before it gets octets.
  void enter(Block& block) {
    if (districts_.empty() || districts_[open_].blocks == kBlocksInDistrict) openDistrict();
    block.first_slab = static_cast<std::uint32_t>(open_ * kSlabsInDistrict);
    ++districts_[open_].blocks;
  }
  /// To be called when a block goes; its octets must have been released.
  void leave(const Block& block) { --districts_[districtOf(block)].blocks; }

  /// Gives an octet of a block its place: raw memory for eight nodes, which it returns.
  NODE* allocate(Source& source, Block& block, int octet) {
    const bool leaves = isOfLeaves(block, octet);
    const OctetRef ref = take(stockOf(source, block, octet), block.first_slab, !leaves);
    block.setRef(octet, ref);
    NODE* nodes = this->nodes(block.first_slab, ref);
    if (leaves) return nodes;
    std::memset(static_cast<void*>(nodes), 0, kOctetBytes);  // Trunk compares octets whole
    owner(SlabHeader::around(nodes), ref & kIndexMask) =
        std::uint64_t{reinterpret_cast<std::uintptr_t>(&block)} << kNumberBits | static_cast<unsigned>(octet);
    return nodes;
  }

  /// Gives the memory back; the nodes must have been destroyed.
  void release(Source& source, const Block& block, int octet) {
    Stock& stock = stockOf(source, block, octet);
    std::memcpy(static_cast<void*>(nodes(block, octet)), &stock.released, sizeof stock.released);
    stock.released = block.ref(octet);
  }

  NODE* nodes(const Block& block, int octet) const { return nodes(block.first_slab, block.ref(octet)); }

  /// Where a node of this pool sits, by an address inside the node; empty for a depth-16 leaf.
  static NodeRef locate(const void* node) {
    const SlabHeader* slab = SlabHeader::around(node);
    if (!slab->inner) return {};
    const char* first = reinterpret_cast<const char*>(slab) + kHeaderBytes;
    const auto index = static_cast<std::size_t>(static_cast<const char*>(node) - first) / sizeof(NODE);
    const std::uint64_t tagged = owner(slab, index / 8);
    constexpr std::uint64_t kNumber = (1 << kNumberBits) - 1;
    return {reinterpret_cast<Block*>(static_cast<std::uintptr_t>(tagged >> kNumberBits)),
            static_cast<int>((tagged & kNumber) * 8 + index % 8)};
  }

  /// Forgets all octets, whose memory is about to be freed; the nodes must have been destroyed.
  void clear() {
    forEachSlab([](const SlabHeader* slab) { removeSlab(slab); });
    slabs_ = decltype(slabs_)();
    districts_ = decltype(districts_)();
    open_ = 0;
    sources_ = std::vector<Source>(1);
  }

  /// Bytes in use: what was ever handed out (released octets are kept for reuse).
  std::size_t memoryUsage() const {
    std::size_t bytes = 0;
    forEachSlab([&bytes](const SlabHeader* slab) {
      bytes += kHeaderBytes + (slab->inner ? kInnerCapacity * kInnerBytes : kLeafCapacity * kOctetBytes);
    });
    for (const Source& source : sources_)
      for (const Stocks& stocks : source.districts)
        bytes -= stocks.leaves.left * kOctetBytes + stocks.inner.left * kInnerBytes;
    return bytes;
  }

 private:
  static constexpr std::size_t kOctetBytes = 8 * sizeof(NODE);
  static constexpr std::size_t kHeaderBytes = std::max<std::size_t>(64, alignof(NODE));
  static constexpr OctetRef kLeafCapacity = (kSlabBytes - kHeaderBytes) / kOctetBytes;
  static constexpr std::size_t kInnerBytes = kOctetBytes + sizeof(std::uint64_t);
  static constexpr OctetRef kInnerCapacity = (kSlabBytes - kHeaderBytes) / kInnerBytes;
  static constexpr int kIndexBits = std::bit_width(kLeafCapacity - 1);
  static constexpr OctetRef kIndexMask = (OctetRef{1} << kIndexBits) - 1;
  static constexpr std::size_t kSlabsInDistrict = std::size_t{1} << (kRefBits - kIndexBits);
  // If each has all its octets, a quarter of the slabs holds them: the other threads' released ones cannot be reused.
  static constexpr std::size_t kBlocksInDistrict = kSlabsInDistrict / 4 * kInnerCapacity / kOctets;
  static constexpr int kNumberBits = 7;  // of an octet; no address has more than 57

  static_assert(kInnerCapacity >= 1, "a node type of many kilobytes: keep such data outside of the nodes");
  static_assert(sizeof(SlabHeader) <= kHeaderBytes);
  static_assert(kOctets < 1 << kNumberBits);

  struct District {
    std::size_t blocks = 0;
    std::size_t slabs = 0;
  };

  static std::uint64_t& owner(const SlabHeader* slab, std::size_t index) {
    constexpr std::size_t kFirst = (kHeaderBytes + kInnerCapacity * kOctetBytes + 7) / 8 * 8;
    static_assert(kFirst + kInnerCapacity * sizeof(std::uint64_t) <= kSlabBytes);
    char* start = reinterpret_cast<char*>(const_cast<SlabHeader*>(slab));
    return reinterpret_cast<std::uint64_t*>(start + kFirst)[index];
  }

  static std::size_t districtOf(const Block& block) { return block.first_slab / kSlabsInDistrict; }
  static bool isOfLeaves(const Block& block, int octet) {
    return block.level() == kRegionLevel && octet < kMiddleOctet;
  }
  static Stock& stockOf(Source& source, const Block& block, int octet) {
    Stocks& stocks = source.districts[districtOf(block)];
    return isOfLeaves(block, octet) ? stocks.leaves : stocks.inner;
  }

  // The numbers of a slab's octets go on from those of the slab before; see slabs_.
  NODE* nodes(std::size_t first_slab, OctetRef ref) const {
    return reinterpret_cast<NODE*>(slabs_[first_slab + (ref >> kIndexBits)] + std::size_t{ref} * kOctetBytes);
  }

  template <class F>
  void forEachSlab(F&& visit) const {
    for (std::size_t d = 0; d < districts_.size(); ++d)
      for (std::size_t n = 0; n < districts_[d].slabs; ++n)
        visit(SlabHeader::around(nodes(d * kSlabsInDistrict, static_cast<OctetRef>(n << kIndexBits))));
  }

  OctetRef take(Stock& stock, std::size_t first_slab, bool inner) {
    if (stock.released != kNone) {
      const OctetRef ref = stock.released;
      std::memcpy(&stock.released, static_cast<const void*>(nodes(first_slab, ref)), sizeof stock.released);
      return ref;
    }
    if (stock.left == 0) refill(stock, first_slab, inner);
    --stock.left;
    return stock.next++;
  }

  void refill(Stock& stock, std::size_t first_slab, bool inner) {
    const std::lock_guard lock(mutex_);  // once for thousands of octets
    std::size_t& slabs = districts_[first_slab / kSlabsInDistrict].slabs;
    if (slabs == kSlabsInDistrict) throw std::length_error("rhmap: more than 2^24 octets in a part of a map");
    stock.next = static_cast<OctetRef>(slabs << kIndexBits);
    if (first_slab + slabs >= slabs_.size()) slabs_.resize(first_slab + slabs + 1);
    slabs_[first_slab + slabs] =
        reinterpret_cast<std::uintptr_t>(newSlab(inner)) + kHeaderBytes - std::size_t{stock.next} * kOctetBytes;
    stock.left = inner ? kInnerCapacity : kLeafCapacity;
    ++slabs;
  }

  SlabHeader* newSlab(bool inner) {
    auto* slab = new (pieces_->allocate()) SlabHeader{inner, store_, children_};
    addSlab(slab);
    return slab;
  }

  /// Where there is most room, or a new one if that is little.
  void openDistrict() {
    open_ = 0;
    for (std::size_t i = 1; i < districts_.size(); ++i)
      if (districts_[i].blocks < districts_[open_].blocks) open_ = i;
    if (!districts_.empty() && districts_[open_].blocks <= kBlocksInDistrict / 2) return;
    if ((districts_.size() + 1) * kSlabsInDistrict > std::numeric_limits<std::uint32_t>::max())
      throw std::length_error("rhmap: more than 2^32 pieces in one map");
    open_ = districts_.size();
    slabs_.resize(open_ * kSlabsInDistrict + 1);  // who asks for memory need not know that there is none yet
    for (Source& source : sources_) source.districts.resize(open_ + 1);
    districts_.emplace_back();
  }

  PiecePool* pieces_;
  const void* store_;
  NodeChildren (*children_)(const void*, const void*);
  // Slab n of district d is number d * kSlabsInDistrict + n, up to the last that is in use. Here are the addresses
  // where octet 0 of the district would be, if its slabs were one after the other: no octet needs its number in its
  // slab.
  std::vector<std::uintptr_t> slabs_;
  std::vector<District> districts_;
  std::size_t open_ = 0;  // where new blocks go
  std::vector<Source> sources_ = std::vector<Source>(1);
  std::mutex mutex_;
};

}  // namespace rhmap
