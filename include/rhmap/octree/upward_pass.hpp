// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "rhmap/octree/structure.hpp"

namespace rhmap {

/// Prunes or recomputes what lies above many changed regions, every node once: what OctoMap does after each single
/// change comes to the same, as the last time counts.
template <class NODE>
class UpwardPass {
 public:
  explicit UpwardPass(BlockStore<NODE>& store) : store_(store) {}

  /// A cell of a block of this level has changed.
  void add(NodeRef cell) {
    if (cell.block != last_) {
      last_ = cell.block;
      last_cells_ = &levels_[cell.block->level()][cell.block];
    }
    (*last_cells_)[static_cast<std::size_t>(cell.slot) >> 6] |= std::uint64_t{1} << (cell.slot & 63);
  }

  /// Goes up from all cells that were added.
  void run() {
    for (int level = kRegionLevel - 1; level >= 0; --level)
      for (const auto& [block, cells] : levels_[static_cast<std::size_t>(level)]) climb(block, cells);
  }

 private:
  using Cells = std::array<std::uint64_t, 8>;  // which of a block's

  /// From cells of a block to the cell above it.
  void climb(Block* block, const Cells& cells) {
    for (int top = 0; top < 8; ++top) {
      const std::uint64_t word = cells[static_cast<std::size_t>(top)];
      if (word == 0) continue;
      for (int i = 0; i < 8; ++i)
        if ((word >> (8 * i) & 0xff) != 0)
          structure::summarise(store_, NodeRef{block, kMiddleSlot + 8 * top + i}, NodeRef{block, 64 * top + 8 * i});
      if (block->level() != 0)
        structure::summarise(store_, NodeRef{block, kTopSlot + top}, NodeRef{block, kMiddleSlot + 8 * top});
    }
    if (block->level() == 0) return;  // its one middle node is the root
    const NodeRef above = store_.parent({block, kTopSlot});
    structure::summarise(store_, above, NodeRef{block, kTopSlot});
    add(above);
  }

  BlockStore<NODE>& store_;
  std::array<std::unordered_map<Block*, Cells>, kRegionLevel> levels_;
  const Block* last_ = nullptr;
  Cells* last_cells_ = nullptr;
};

}  // namespace rhmap
