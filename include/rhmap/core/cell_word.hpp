// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "rhmap/core/key.hpp"

namespace rhmap {

/// A cell's key as one word: the Morton index in its region (9 bits), above it the region's 13 bits an axis. So that
///   word & 63 is the cell in its octant (the 4 x 4 x 4 cells under a depth-14 node), word >> 6 names the octant,
///   word >> 9 the region, and a step along an axis is one addition within that axis' bits.
namespace cell_word {

inline constexpr std::uint64_t kAxis[3] = {
    std::uint64_t{0b001001001} | std::uint64_t{0x1fff} << 9,
    std::uint64_t{0b010010010} | std::uint64_t{0x1fff} << 22,
    std::uint64_t{0b100100100} | std::uint64_t{0x1fff} << 35,
};

inline std::uint64_t fromKey(const OcTreeKey& key) {
  return static_cast<std::uint64_t>(cellIndex(key, kRegionLevel)) | static_cast<std::uint64_t>(key[0] >> 3) << 9 |
         static_cast<std::uint64_t>(key[1] >> 3) << 22 | static_cast<std::uint64_t>(key[2] >> 3) << 35;
}

/// The region's smallest key, as keyWord().
inline std::uint64_t regionWord(std::uint64_t word) {
  return (word & 0x1fff << 9) >> 6 | (word & std::uint64_t{0x1fff} << 22) >> 3 | (word & std::uint64_t{0x1fff} << 35);
}

/// blockKey() of the region.
inline std::uint64_t regionKey(std::uint64_t word) {
  return regionWord(word) | static_cast<std::uint64_t>(kRegionLevel) << 48;
}

inline OcTreeKey toKey(std::uint64_t word) {
  return keyOfWord(regionWord(word) | cellOffset(word & (kCellsInBlock - 1)));
}

/// What to add along an axis for a step of +1, -1 or 0.
constexpr std::uint64_t stepAlong(int axis, int step) {
  return step > 0 ? std::uint64_t{1} << axis : step < 0 ? kAxis[axis] : 0;
}

/// One step: an addition whose carries run through this axis' bits only.
constexpr std::uint64_t advance(std::uint64_t word, std::uint64_t axis_mask, std::uint64_t step) {
  return (((word | ~axis_mask) + step) & axis_mask) | (word & ~axis_mask);
}

/// The bits in which a cell outside of a cube of 2^bits cells an edge (3 or more, as the tree is divided) differs from
/// those inside.
constexpr std::uint64_t outsideOfCube(int bits) {
  const std::uint64_t inside = (std::uint64_t{1} << (bits - 3)) - 1;
  return ~(std::uint64_t{511} | inside << 9 | inside << 22 | inside << 35);
}

}  // namespace cell_word

}  // namespace rhmap
