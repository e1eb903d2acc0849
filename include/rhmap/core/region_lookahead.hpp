// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>

#include "rhmap/core/block_store.hpp"
#include "rhmap/core/prefetch.hpp"

namespace rhmap {

/// The existing cell that comes next in a block; kCells if there is none.
inline int nextCell(const Block& block, int cell) {
  std::uint64_t later = ~std::uint64_t{1} << (cell & 63);
  for (int octant = cell >> 6; octant < 8; ++octant, later = ~std::uint64_t{0})
    if (const std::uint64_t cells = masksFrom(block, 8 * octant) & later; cells != 0)
      return 64 * octant + std::countr_zero(cells);
  return kCells;
}

/// Asks for the memory of what a walk over all regions comes to after the one below `above`, a node at depth 13: each
/// region by and by, because one cannot ask for its nodes before its block has come, nor for that before its entry in
/// the hash table has. (See BlockIndex::prefetch.)
template <class NODE>
[[gnu::always_inline]] inline void prefetchRegionsAfter(const BlockStore<NODE>& store, NodeRef above) {
  int cell = above.slot;
  const auto next = [&] {
    if (cell != kCells) cell = nextCell(*above.block, cell);
    return cell != kCells;
  };
  const auto region = [&] { return store.findRegion(above.block->cornerOf(cell)); };
  if (!next()) return;
  if (const Block* first = region()) {
    for (int octet = 0; octet < kMiddleOctet; ++octet) __builtin_prefetch(store.octet(first, octet).nodes);
  }
  if (!next()) return;
  if (const Block* second = region()) prefetchWhole(second);
  if (next()) store.prefetchRegion(above.block->cornerOf(cell));
}

}  // namespace rhmap
