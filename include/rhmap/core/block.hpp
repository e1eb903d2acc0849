// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "rhmap/core/key.hpp"

namespace rhmap {

/// Slots of a block. A block is a flat piece of octree: 512 cells in Morton order (slots 0 ... 511), the 64 nodes one
/// depth above them (512 ... 575) and the 8 nodes above those (576 ... 583). Eight siblings are an octet: octets 0 ...
/// 63 hold the cells, 64 ... 71 the middle nodes, 72 the top nodes. Hence the whole of the tree's structure:
///   - the children of slot s >= 512 are octet s - 512 of the same block;
///   - the children of a cell are octet 72 of the block of the next level that lies under the cell.
inline constexpr int kCells = kCellsInBlock;
inline constexpr int kMiddleSlot = 512;
inline constexpr int kTopSlot = 576;
inline constexpr int kSlots = 584;
inline constexpr int kOctets = 73;
inline constexpr int kMiddleOctet = 64;
inline constexpr int kTopOctet = 72;
inline constexpr int kRootSlot = kMiddleSlot;  ///< in the block of level 0

constexpr int childOctet(int slot) { return slot - kCells; }
constexpr int parentSlot(int octet) { return octet + kCells; }

/// Depths of a slot below its block's middle: cells +1, middle 0, top -1.
constexpr int depthStep(int slot) { return slot < kMiddleSlot ? 1 : slot < kTopSlot ? 0 : -1; }

/// Slot of a cell's ancestor (or itself) at the given depth step.
constexpr int slotAbove(int cell, int depth_step) {
  return depth_step == 1 ? cell : depth_step == 0 ? kMiddleSlot + (cell >> 3) : kTopSlot + (cell >> 6);
}

/// First cell (Morton index) below a slot.
constexpr int firstCell(int slot) {
  return slot < kMiddleSlot ? slot : slot < kTopSlot ? (slot - kMiddleSlot) << 3 : (slot - kTopSlot) << 6;
}

/// An octet's place in the OctetPool, among those of its block's district. Three bytes in a block.
using OctetRef = std::uint32_t;
inline constexpr int kRefBits = 24;

/// Which nodes exist and where they are kept. Five cache lines; the values live in the OctetPool.
struct alignas(64) Block {
  std::uint64_t key;                               ///< blockKey()
  Block* parent;                                   ///< holds the cell above this block; null at level 0
  std::uint32_t stamp;                             ///< when it was last noted as changed, see BlockJournal
  std::uint32_t first_slab;                        ///< of its district of the OctetPool
  std::array<std::uint8_t, kOctets> mask;          ///< mask[o], bit i: node i of octet o exists
  std::array<std::uint8_t, 3 * kOctets + 1> refs;  ///< see ref(); it reads four bytes

  int level() const { return blockLevel(key); }          ///< 0 (root) ... 5 (region)
  OcTreeKey corner() const { return blockCorner(key); }  ///< smallest key inside

  /// Where octet o is; valid where mask[o] != 0.
  OctetRef ref(int octet) const {
    std::uint32_t word;
    std::memcpy(&word, refs.data() + 3 * static_cast<unsigned>(octet), sizeof word);
    if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap32(word);
    return word & ((OctetRef{1} << kRefBits) - 1);
  }
  void setRef(int octet, OctetRef ref) {
    std::uint8_t* place = refs.data() + 3 * octet;
    for (int i = 0; i < 3; ++i) place[i] = static_cast<std::uint8_t>(ref >> 8 * i);
  }

  bool has(int slot) const { return mask[static_cast<unsigned>(slot) >> 3] >> (slot & 7) & 1; }

  unsigned depth(int slot) const { return static_cast<unsigned>(3 * level() + depthStep(slot)); }

  /// Smallest key of the node in a slot.
  OcTreeKey cornerOf(int slot) const {
    return keyOfWord(key + (cellOffset(static_cast<unsigned>(firstCell(slot))) << cellShift(level())));
  }
};
static_assert(sizeof(Block) == 320);

/// The masks of eight octets, the first in the lowest byte.
inline std::uint64_t masksFrom(const Block& block, int first_octet) {
  std::uint64_t word;
  std::memcpy(&word, block.mask.data() + first_octet, sizeof word);
  if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
  return word;
}

/// Adds nodes to eight octets, the first in the lowest byte.
inline void addToMasks(Block& block, int first_octet, std::uint64_t nodes) {
  std::uint64_t word = masksFrom(block, first_octet) | nodes;
  if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
  std::memcpy(block.mask.data() + first_octet, &word, sizeof word);
}

/// Bit 7 of each byte that is not 0.
constexpr std::uint64_t nonzeroBytes(std::uint64_t bytes) {
  constexpr std::uint64_t kLow = 0x7f7f'7f7f'7f7f'7f7f;
  return (((bytes & kLow) + kLow) | bytes) & ~kLow;
}

/// A node's place. Empty (block null) where there is none.
struct NodeRef {
  Block* block = nullptr;
  int slot = 0;

  explicit operator bool() const { return block != nullptr; }
  bool operator==(const NodeRef&) const = default;
  /// At depth 16, as most nodes are.
  bool isCell() const { return slot < kCells && block->level() == kRegionLevel; }
  unsigned depth() const { return block->depth(slot); }
  OcTreeKey corner() const {
    return isCell() ? keyOfWord(block->key | cellOffset(static_cast<unsigned>(slot))) : block->cornerOf(slot);
  }
  int sibling() const { return slot & 7; }
};

}  // namespace rhmap
