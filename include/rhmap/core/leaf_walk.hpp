// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "rhmap/core/block.hpp"

namespace rhmap {

/// The leaves that a LeafWalk goes to: all of them.
struct AllLeaves {
  static constexpr bool kAll = true;
  static constexpr std::uint64_t cells(int /*octant*/) { return ~std::uint64_t{0}; }
  static constexpr std::uint64_t middles(int /*octant*/) { return ~std::uint64_t{0}; }
  static constexpr std::uint64_t top(int /*octant*/) { return 1; }
};

/// OctoMap's test of a node against a box of keys, along one axis: on the upper side of nodes that are larger than a
/// cell it takes one cell more than there is. `first`: smallest key of the node, `edge`: its cells an axis.
constexpr bool touchesBox(int first, int edge, int min, int max) {
  return min <= first + (edge == 1 ? 0 : edge) && max >= first;
}

/// Those that touch a box of keys, by touchesBox().
class LeavesInBox {
 public:
  static constexpr bool kAll = false;

  LeavesInBox() = default;
  /// In the region with this corner.
  LeavesInBox(const OcTreeKey& corner, const OcTreeKey& min, const OcTreeKey& max) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const auto touching = [&](int edge) {
        unsigned nodes = 0;
        for (int i = 0; i < 8 / edge; ++i)
          nodes |= unsigned{touchesBox(corner[axis] + i * edge, edge, min[axis], max[axis])} << i;
        return nodes;
      };
      cells_[axis] = static_cast<std::uint8_t>(touching(1));
      middles_[axis] = static_cast<std::uint8_t>(touching(2));
      tops_[axis] = static_cast<std::uint8_t>(touching(4));
    }
  }

  /// Of the 64 cells of an octant, one a bit.
  std::uint64_t cells(int octant) const {
    std::uint64_t all = ~std::uint64_t{0};
    for (unsigned axis = 0; axis < 3; ++axis) all &= kLayers[axis][cells_[axis] >> 4 * side(octant, axis) & 15];
    return all;
  }
  /// Of its eight middle nodes, bit 8 i for node i.
  std::uint64_t middles(int octant) const {
    std::uint64_t all = ~std::uint64_t{0};
    for (unsigned axis = 0; axis < 3; ++axis)
      all &= kLayers[axis][kTwice[middles_[axis] >> 2 * side(octant, axis) & 3]];
    return all;
  }
  /// Bit 0: of its top node.
  std::uint64_t top(int octant) const {
    unsigned all = 1;
    for (unsigned axis = 0; axis < 3; ++axis) all &= unsigned{tops_[axis]} >> side(octant, axis);
    return all;
  }

 private:
  static int side(int octant, unsigned axis) { return octant >> axis & 1; }

  /// For each axis and choice of an octant's four layers across it: the cells in these.
  static constexpr auto kLayers = [] {
    std::array<std::array<std::uint64_t, 16>, 3> layers{};
    for (unsigned axis = 0; axis < 3; ++axis)
      for (unsigned chosen = 0; chosen < 16; ++chosen)
        for (unsigned cell = 0; cell < 64; ++cell) {
          const unsigned layer = (cell >> axis & 1) | (cell >> (axis + 2) & 2);
          layers[axis][chosen] |= std::uint64_t{chosen >> layer & 1} << cell;
        }
    return layers;
  }();
  static constexpr std::uint8_t kTwice[] = {0, 3, 12, 15};  // each of two bits as two

  // For each axis, which of the layers of nodes across it the box touches.
  std::array<std::uint8_t, 3> cells_{}, middles_{}, tops_{};
};

/// The leaves of a region, depth first, 64 cells a word: which child comes next is hard to guess, the next bit is not.
template <class Wanted = AllLeaves>
class LeafWalk {
 public:
  LeafWalk() = default;
  explicit LeafWalk(const Block& region, const Wanted& wanted = {}) : region_(&region), octant_(-1), wanted_(wanted) {}

  /// True if the next leaf is among the same 64 cells.
  bool hasMore() const { return rest_ != 0; }

  /// Goes on to where the next leaf is; false after the last.
  bool findNext() {
    if (hasMore()) [[likely]]
      return true;
    while (octant_ < 7) {
      ++octant_;
      if ((region_->mask[kTopOctet] >> octant_ & 1) == 0) continue;
      const std::uint64_t middles = region_->mask[static_cast<unsigned>(kMiddleOctet + octant_)];
      const std::uint64_t cells = masksFrom(*region_, 8 * octant_);
      const std::uint64_t childless = nonzeroBytes(middles * kEach & kDiagonal) & ~nonzeroBytes(cells);
      larger_ = middles == 0 ? wanted_.top(octant_) : childless >> 7 & wanted_.middles(octant_);
      first_larger_ = middles == 0 ? kTopSlot + octant_ : kMiddleSlot + 8 * octant_;
      rest_ = (cells & wanted_.cells(octant_)) | larger_;
      if (Wanted::kAll || rest_ != 0) return true;
    }
    return false;
  }

  /// Takes the next leaf, if hasMore() or findNext() has found it.
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
  [[no_unique_address]] Wanted wanted_;
};

}  // namespace rhmap
