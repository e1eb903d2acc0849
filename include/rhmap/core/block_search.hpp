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

/// The node in a slot, or the leaf of the same block that contains it; empty if unknown.
inline NodeRef searchIn(Block* block, int slot) {
  if (block->has(slot)) return {block, slot};
  for (slot = parentSlot(slot >> 3); slot < kSlots; slot = parentSlot(slot >> 3))
    if (block->has(slot)) return block->mask[childOctet(slot)] == 0 ? NodeRef{block, slot} : NodeRef{};
  return {};
}

/// The same for a cell that no other block lies below. Without branches: at which of the three depths a ray or a cloud
/// meets the map is anybody's guess.
inline Found searchCell(Block* block, int cell) {
  constexpr int kFirstSlot[] = {0, kMiddleSlot, kTopSlot};
  const unsigned cells = block->mask[static_cast<unsigned>(cell) >> 3];
  const unsigned middles = block->mask[kMiddleOctet + (static_cast<unsigned>(cell) >> 6)];
  const unsigned tops = block->mask[kTopOctet];
  // 0: among the cells; 1: there are none, but a middle node may be; 2: nor has such a node any siblings.
  const int up = (cells == 0) + ((cells | middles) == 0);
  const unsigned mask = up == 0 ? cells : up == 1 ? middles : tops;
  const int index = cell >> (3 * up);
  return {(mask >> (index & 7) & 1) != 0 ? NodeRef{block, kFirstSlot[up] + index} : NodeRef{}, up};
}

}  // namespace rhmap
