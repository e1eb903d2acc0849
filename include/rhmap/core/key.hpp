// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>  // OcTreeKey.h uses this and <vector> without including them
#include <cstdint>
#include <vector>

#define RHMAP_KEYS_ONLY  // in the compat world: without our set of keys, which needs this file
#include <octomap/OcTreeKey.h>
#undef RHMAP_KEYS_ONLY
#include <octomap/octomap_types.h>

/// How a 16-bit OctoMap key splits into a block and a cell of that block.
///
/// The tree has depths 0 (root) to 16 (cells). A block holds three of them, its levels count from the root:
///
///     level      0         1        2        3         4           5 = a region of 8 x 8 x 8 cells
///     depths   -1 0 1    2 3 4    5 6 7    8 9 10   11 12 13    14 15 16
///
/// (depth -1 does not exist: the root block uses one node of its middle depth and eight of its lowest).
namespace rhmap {

using octomap::key_type;
using octomap::KeyRay;
using octomap::OcTreeKey;
using octomap::point3d;

inline constexpr unsigned kTreeDepth = 16;
inline constexpr key_type kTreeMaxVal = 32768;  ///< key of the coordinate 0
inline constexpr int kRegionLevel = 5;          ///< blocks of this level are the regions
inline constexpr int kRegionBits = 3;           ///< a region is a cube of 2^3 cells an edge

/// Bits of a key below one cell of a block of this level: a cell is 2^shift keys wide.
constexpr int cellShift(int level) { return 3 * (kRegionLevel - level); }

/// Spreads three bits so that two others fit between each: 0b111 -> 0b1001001.
constexpr unsigned spread3(unsigned bits) { return (bits & 1) | (bits & 2) << 2 | (bits & 4) << 4; }

/// Inverse of spread3 on the bits 0, 3 and 6.
constexpr unsigned gather3(unsigned bits) { return (bits & 1) | (bits >> 2 & 2) | (bits >> 4 & 4); }

inline constexpr unsigned kCellsInBlock = 512;

/// The three parts of a key side by side, 16 bits each, x lowest.
inline std::uint64_t keyWord(const OcTreeKey& key) {
  return key[0] | static_cast<std::uint64_t>(key[1]) << 16 | static_cast<std::uint64_t>(key[2]) << 32;
}

/// Inverse of keyWord(); what is above the three parts is left aside.
inline OcTreeKey keyOfWord(std::uint64_t word) {
  return {static_cast<key_type>(word), static_cast<key_type>(word >> 16), static_cast<key_type>(word >> 32)};
}

/// Morton index (x lowest bit) of the cell that holds `key` within its block of this level: 0 ... 511. Inlined by
/// force, like blockKey(): the level is a constant where it counts.
[[gnu::always_inline]] inline int cellIndex(const OcTreeKey& key, int level) {
  const int shift = cellShift(level);
  const std::uint64_t three_bits = 0xffffU & 7U << shift;  // of an axis; at level 0 there is but one
  std::uint64_t all = (keyWord(key) & three_bits * 0x1'0001'0001) >> shift;
  all = (all | all << 2 | all << 4) & 0x0049'0049'0049;                         // spread3 of the three at once
  return static_cast<int>(all * (1ULL << 55 | 1ULL << 40 | 1ULL << 25) >> 55);  // their nine bits are the highest
}

namespace detail {
inline constexpr auto kCellOffsets = [] {
  std::array<std::uint64_t, kCellsInBlock> all{};
  for (unsigned cell = 0; cell < kCellsInBlock; ++cell)
    for (unsigned axis = 0; axis < 3; ++axis) all[cell] |= std::uint64_t{gather3(cell >> axis)} << 16 * axis;
  return all;
}();
}  // namespace detail

/// Inverse of cellIndex() in a region: the cell's place from the region's smallest key, as keyWord().
[[gnu::always_inline]] inline std::uint64_t cellOffset(unsigned cell) { return detail::kCellOffsets[cell]; }

/// Names a block in the whole tree: its smallest key as keyWord(), above that the level.
[[gnu::always_inline]] inline std::uint64_t blockKey(const OcTreeKey& key, int level) {
  const std::uint64_t kept = 0xffffU & ~0U << (cellShift(level) + 3);
  return (keyWord(key) & kept * 0x1'0001'0001) | static_cast<std::uint64_t>(level) << 48;
}

/// Level of the block with this blockKey().
inline int blockLevel(std::uint64_t block_key) { return static_cast<int>(block_key >> 48); }

/// Smallest key in the block with this blockKey().
inline OcTreeKey blockCorner(std::uint64_t block_key) { return keyOfWord(block_key); }

/// OctoMap's name for a node: the key of its centre. Leaves at depth 16 are named by themselves, larger nodes by the
/// first cell above their middle.
inline OcTreeKey centreKey(const OcTreeKey& corner, unsigned depth) {
  if (depth == kTreeDepth) return corner;
  const auto half = static_cast<key_type>(1U << (kTreeDepth - 1 - depth));
  return {static_cast<key_type>(corner[0] + half), static_cast<key_type>(corner[1] + half),
          static_cast<key_type>(corner[2] + half)};
}

}  // namespace rhmap
