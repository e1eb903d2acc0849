// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "rhmap/core/block_store.hpp"
#include "rhmap/core/cell_word.hpp"

namespace rhmap {

/// Searches cells one after the other, and remembers the last region, or the cube around it where there is none: for
/// paths, where most steps stay in it. Lives in one function of one thread, while the map does not change.
template <class NODE>
class RegionCursor {
 public:
  explicit RegionCursor(const BlockStore<NODE>& store) : store_(store) {}

  /// BlockStore::search at depth 16: the cell or the leaf that contains it, null where unknown.
  const NODE* search(const OcTreeKey& key) { return search(cell_word::fromKey(key)); }
  const NODE* search(std::uint64_t cell) {
    if (((cell ^ last_) & outside_) != 0) moveTo(cell);
    if (region_ == nullptr) return whole_;
    return store_.findNode(*region_, static_cast<unsigned>(cell & (kCellsInBlock - 1)));
  }

  /// Around the last cell, the cube of 2^bits cells an edge in which every search finds the same; 0 in a region.
  int bits() const { return bits_; }

 private:
  void moveTo(std::uint64_t cell) {
    last_ = cell;
    bits_ = 0;
    region_ = store_.findBlock(cell_word::regionKey(cell));
    if (region_ == nullptr) {
      const Found found = store_.searchAbove(cell_word::toKey(cell), kRegionLevel);
      whole_ = store_.nodeOrNull(found.node);
      bits_ = found.bits;
    }
    outside_ = cell_word::outsideOfCube(std::max(bits_, kRegionBits));
  }

  const BlockStore<NODE>& store_;
  std::uint64_t last_ = ~std::uint64_t{0};  // no cell
  std::uint64_t outside_ = ~std::uint64_t{0};
  Block* region_ = nullptr;      // null: there is none here, and
  const NODE* whole_ = nullptr;  // this holds for all its cells
  int bits_ = 0;
};

}  // namespace rhmap
