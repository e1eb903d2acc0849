// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "rhmap/core/block_store.hpp"

namespace rhmap {

/// Searches cells one after the other, and remembers the last region: for paths, where most steps stay in it. Lives in
/// one function of one thread, while the map does not change.
template <class NODE>
class RegionCursor {
 public:
  explicit RegionCursor(const BlockStore<NODE>& store) : store_(store) {}

  /// BlockStore::search at depth 16: the cell or the leaf that contains it, null where unknown.
  const NODE* search(const OcTreeKey& key) {
    if (const std::uint64_t name = blockKey(key, kRegionLevel); name != name_) {
      name_ = name;
      region_ = store_.findRegion(key);
      if (region_ == nullptr) whole_ = store_.searchAbove(key, kRegionLevel);
    }
    const auto found = region_ == nullptr ? whole_ : searchCell(region_, cellIndex(key, kRegionLevel));
    bits_ = found.bits;
    return found.node ? store_.node(found.node) : nullptr;
  }

  /// The cube of 2^bits cells an edge around the last key in which every search finds the same.
  int bits() const { return bits_; }

 private:
  const BlockStore<NODE>& store_;
  std::uint64_t name_ = std::numeric_limits<std::uint64_t>::max();
  Block* region_ = nullptr;  // null: there is none here, and
  Found whole_{};            // this holds for all its cells
  int bits_ = 0;
};

}  // namespace rhmap
