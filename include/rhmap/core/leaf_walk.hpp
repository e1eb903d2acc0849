// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>

#include "rhmap/core/block.hpp"

namespace rhmap {

/// The leaves of a region, depth first, 64 cells a word: which child comes next is hard to guess, the next bit is not.
class LeafWalk {
 public:
  LeafWalk() = default;
  explicit LeafWalk(const Block& region) : region_(&region), octant_(-1) {}

  /// Slot of the next leaf; -1 after the last.
  int next() {
    while (rest_ == 0) {
      if (octant_ >= 7) return -1;
      ++octant_;
      if ((region_->mask[kTopOctet] >> octant_ & 1) == 0) continue;
      const std::uint64_t middles = region_->mask[static_cast<unsigned>(kMiddleOctet + octant_)];
      if (middles == 0) return kTopSlot + octant_;
      const std::uint64_t cells = masksFrom(*region_, 8 * octant_);
      leaves_ = (nonzeroBytes(middles * kEach & kDiagonal) & ~nonzeroBytes(cells)) >> 7;
      rest_ = cells | leaves_;
    }
    const int bit = std::countr_zero(rest_);
    const bool is_middle = leaves_ >> bit & 1;
    rest_ &= rest_ - 1;
    return is_middle ? kMiddleSlot + 8 * octant_ + (bit >> 3) : 64 * octant_ + bit;
  }

 private:
  static constexpr std::uint64_t kEach = 0x0101'0101'0101'0101;
  static constexpr std::uint64_t kDiagonal = 0x8040'2010'0804'0201;  // bit i of byte i

  const Block* region_ = nullptr;
  int octant_ = 7;  // the 4 x 4 x 4 cells under a top node
  std::uint64_t rest_ = 0;
  std::uint64_t leaves_ = 0;  // middle nodes without cells: bit 8 i, where the first of these would be
};

}  // namespace rhmap
