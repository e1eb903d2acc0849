// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rhmap/core/block.hpp"

namespace rhmap {

/// What a search at depth 16 has found: a node, or nothing; and that all cells of the cube of 2^bits cells an edge
/// around the key would have found the same.
struct Found {
  NodeRef node;
  int bits;
};

/// Where a search for a cell ends in a block. A search is as fast as it is short: the fewer instructions it has, the more
/// searches does a processor have under way while one of them waits for memory. Hence what finds the place is inlined by
/// force, and the place stays in registers.
struct CellPlace {
  unsigned up;     ///< depths above the cells: 0 if the cell's octet exists; 1 if not, but its middle octet does; else 2
  unsigned octet;  ///< 0 ... 72
  unsigned child;  ///< 0 ... 7
  unsigned mask;   ///< of that octet

  bool exists() const { return (mask >> child & 1) != 0; }
  int slot() const { return static_cast<int>(octet * 8 + child); }
};

/// The place where a search for a cell ends that no other block lies below. Without branches: at which of the three
/// depths is anybody's guess where searches are not for neighbours.
[[gnu::always_inline]] inline CellPlace placeOf(const Block& block, unsigned cell) {
  static constexpr std::uint8_t kFirstOctet[] = {0, kMiddleOctet, kTopOctet};
  const unsigned cells = block.mask[cell >> 3];
  const unsigned middles = block.mask[kMiddleOctet + (cell >> 6)];
  const unsigned up = (cells == 0) + ((cells | middles) == 0);
  const unsigned index = cell >> (3 * up);
  const unsigned octet = kFirstOctet[up] + (index >> 3);
  return {up, octet, index & 7, block.mask[octet]};
}

/// The same place, guessed from where searches ended before: the node is asked for before the masks are there. For
/// searches in regions, where neighbours are alike, along a ray as in the order of the map.
[[gnu::always_inline]] inline CellPlace likelyPlaceOf(const Block& region, unsigned cell) {
  if (const unsigned cells = region.mask[cell >> 3]; cells != 0) return {0, cell >> 3, cell & 7, cells};
  const unsigned middle = kMiddleOctet + (cell >> 6);
  if (const unsigned middles = region.mask[middle]; middles != 0) return {1, middle, cell >> 3 & 7, middles};
  return {2, kTopOctet, cell >> 6, region.mask[kTopOctet]};
}

/// The node in a slot, or the leaf of the same block that contains it; empty if unknown.
inline NodeRef searchIn(Block* block, int slot) {
  if (block->has(slot)) return {block, slot};
  for (slot = parentSlot(slot >> 3); slot < kSlots; slot = parentSlot(slot >> 3))
    if (block->has(slot)) return block->mask[childOctet(slot)] == 0 ? NodeRef{block, slot} : NodeRef{};
  return {};
}

/// The same for a cell that no other block lies below.
inline Found searchCell(Block* block, int cell) {
  const CellPlace place = placeOf(*block, static_cast<unsigned>(cell));
  return {place.exists() ? NodeRef{block, place.slot()} : NodeRef{}, static_cast<int>(place.up)};
}

}  // namespace rhmap
