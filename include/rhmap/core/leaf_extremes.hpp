// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "rhmap/core/block_store.hpp"
#include "rhmap/core/leaf_walk.hpp"

namespace rhmap {

/// Smallest and largest key of the leaves of each depth, along each axis (keys of lower corners). Looks only into the
/// few regions that stick out of the box of those before.
class LeafExtremes {
 public:
  template <class NODE>
  explicit LeafExtremes(const BlockStore<NODE>& store) {
    store.forEachBlock([&](const Block& block) {
      if (block.level() == kRegionLevel) {
        if (!couldMove(block)) return;
        LeafWalk<> walk(block);
        while (walk.findNext()) add(block, walk.take());
      } else {
        for (int slot = 0; slot < kSlots; ++slot)
          if (block.has(slot) && !store.hasChildren({const_cast<Block*>(&block), slot})) add(block, slot);
      }
    });
  }

  bool hasLeaves(unsigned depth) const { return of_[depth].min[0] <= of_[depth].max[0]; }
  const OcTreeKey& min(unsigned depth) const { return of_[depth].min; }
  const OcTreeKey& max(unsigned depth) const { return of_[depth].max; }

 private:
  static constexpr key_type kLast = std::numeric_limits<key_type>::max();
  struct Extremes {
    OcTreeKey min{kLast, kLast, kLast}, max{0, 0, 0};
  };

  /// Some leaf of the region could be outside of what is known for its depth.
  bool couldMove(const Block& region) const {
    const OcTreeKey corner = region.corner();
    for (unsigned up = 0; up < 3; ++up)
      for (unsigned i = 0; i < 3; ++i)
        if (corner[i] < of_[kTreeDepth - up].min[i] || corner[i] + 8 - (1 << up) > of_[kTreeDepth - up].max[i])
          return true;
    return false;
  }

  void add(const Block& block, int slot) {
    Extremes& known = of_[block.depth(slot)];
    const OcTreeKey corner = block.cornerOf(slot);
    for (unsigned i = 0; i < 3; ++i) {
      known.min[i] = std::min(known.min[i], corner[i]);
      known.max[i] = std::max(known.max[i], corner[i]);
    }
  }

  std::array<Extremes, kTreeDepth + 1> of_;
};

}  // namespace rhmap
