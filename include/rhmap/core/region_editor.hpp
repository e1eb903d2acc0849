// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>

#include "rhmap/core/block.hpp"
#include "rhmap/core/octet_pool.hpp"
#include "rhmap/core/popcount.hpp"

namespace rhmap {

/// Makes and removes nodes inside regions for one of several threads, each of which has regions of its own. What
/// belongs to the whole store is not touched before BlockStore::takeOver(). It counts with every node: in a line of the
/// cache that it shared with another thread's, both would wait at each.
template <class NODE>
class alignas(64) RegionEditor {
 public:
  RegionEditor(OctetPool<NODE>& pool, typename OctetPool<NODE>::Source& source) : pool_(&pool), source_(&source) {}

  /// Nodes of an octet that exists.
  NODE* nodes(const Block& region, int octet) const { return pool_->nodes(region, octet); }

  /// Makes nodes of an octet that are not there yet, with the node type's default value. Returns the octet's nodes.
  NODE* create(Block& region, int octet, unsigned bits) {
    NODE* nodes = claim(region, octet, bits);
    for (unsigned rest = bits; rest != 0; rest &= rest - 1)
      new (static_cast<void*>(nodes + std::countr_zero(rest))) NODE();
    return nodes;
  }

  /// The same for the caller to put nodes there.
  NODE* claim(Block& region, int octet, unsigned bits) {
    std::uint8_t& mask = region.mask[index(octet)];
    NODE* nodes = mask == 0 ? pool_->allocate(*source_, region, octet) : this->nodes(region, octet);
    mask = static_cast<std::uint8_t>(mask | bits);
    made_ += popcount(bits);
    return nodes;
  }

  /// The same for eight octets, the first in the lowest byte. They all exist, as far as they get nodes.
  void claimEight(Block& region, int first_octet, std::uint64_t bits) {
    addToMasks(region, first_octet, bits);
    made_ += popcount(bits);
  }

  /// Removes eight nodes without children.
  void remove(Block& region, int octet) {
    NODE* nodes = this->nodes(region, octet);
    for (int i = 0; i < 8; ++i) nodes[i].~NODE();
    region.mask[index(octet)] = 0;
    pool_->release(*source_, region, octet);
    made_ -= 8;
  }

  /// Nodes made less nodes removed.
  std::ptrdiff_t made() const { return made_; }

 private:
  static std::size_t index(int octet) { return static_cast<std::size_t>(octet); }

  OctetPool<NODE>* pool_;
  typename OctetPool<NODE>::Source* source_;
  std::ptrdiff_t made_ = 0;
};

}  // namespace rhmap
