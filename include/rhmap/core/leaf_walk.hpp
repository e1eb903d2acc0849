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

  /// Goes on to where the next leaf is; false after the last.
  bool findNext() {
    if (rest_ != 0) [[likely]]
      return true;
    while (octant_ < 7) {
      ++octant_;
      if ((region_->mask[kTopOctet] >> octant_ & 1) == 0) continue;
      const std::uint64_t middles = region_->mask[static_cast<unsigned>(kMiddleOctet + octant_)];
      const std::uint64_t cells = masksFrom(*region_, 8 * octant_);
      larger_ = middles == 0 ? 1 : (nonzeroBytes(middles * kEach & kDiagonal) & ~nonzeroBytes(cells)) >> 7;
      first_larger_ = middles == 0 ? kTopSlot + octant_ : kMiddleSlot + 8 * octant_;
      rest_ = cells | larger_;
      return true;
    }
    return false;
  }

  /// Takes the leaf that findNext() has found.
  int take() {
    const int bit = std::countr_zero(rest_);
    const bool is_larger = larger_ >> bit & 1;
    rest_ &= rest_ - 1;
    return is_larger ? first_larger_ + (bit >> 3) : 64 * octant_ + bit;
  }

 private:
  static constexpr std::uint64_t kEach = 0x0101'0101'0101'0101;
  static constexpr std::uint64_t kDiagonal = 0x8040'2010'0804'0201;  // bit i of byte i

  const Block* region_ = nullptr;
  int octant_ = 7;            // the 4 x 4 x 4 cells under a top node
  std::uint64_t rest_ = 0;    // its leaves that are still to come
  std::uint64_t larger_ = 0;  // those above the cells: bit 8 i for the middle node i, bit 0 for the top node
  int first_larger_ = 0;      // slot of the first of these
};

}  // namespace rhmap
