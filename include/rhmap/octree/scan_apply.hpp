// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "rhmap/octree/scan_masks.hpp"
#include "rhmap/octree/structure.hpp"

namespace rhmap {

/// The log-odds that an insertion works with.
struct SensorModel {
  float hit, miss;  ///< added to a cell that is hit / crossed
  float clamp_min, clamp_max;

  /// OctoMap's early abort: this update leaves a cell with this value as it is, and does not even expand a pruned leaf.
  bool settled(float value, float update) const {
    return (update >= 0 && value >= clamp_max) || (update <= 0 && value <= clamp_min);
  }
  float updated(float value, float update) const {
    value += update;
    return value < clamp_min ? clamp_min : value > clamp_max ? clamp_max : value;
  }
};

/// Puts a marked scan into the map: the same nodes and values as OctoMap's updateNode for every cell, but region by
/// region, with every inner node of a region visited once.
template <class NODE>
class ScanApplier {
 public:
  ScanApplier(BlockStore<NODE>& store, const SensorModel& model, bool lazy)
      : store_(store), model_(model), lazy_(lazy) {}

  void apply(const RegionMasks& masks) {
    for (std::size_t t = 0; t < 8; ++t) {
      hit_[t] = masks.hit[t];
      free_[t] = masks.free[t] & ~masks.hit[t];
    }
    unsigned fresh = 0;  // octants that are new, as against pruned ones: both have a top node without children
    Block* region = open(masks.corner(), fresh);
    if (region == nullptr) return;

    std::array<std::uint8_t, 8> changed{};
    bool any = false;
    for (std::size_t t = 0; t < 8; ++t) {
      changed[t] = applyOctant(*region, t, fresh >> t & 1);
      any = any || changed[t] != 0;
    }
    if (!any) return;
    store_.touch(region);
    if (!lazy_) summarise(*region, changed);
  }

 private:
  /// The region with a top node for every marked octant; null if nothing in it would change.
  Block* open(const OcTreeKey& corner, unsigned& fresh) {
    Block* region = store_.findRegion(corner);
    if (region == nullptr) {
      const NodeRef deepest = store_.deepest(corner);
      if (deepest && !store_.hasChildren(deepest) && !keepUnsettled(store_.node(deepest)->getLogOdds())) return nullptr;
      bool new_cell = false;
      const NodeRef cell = structure::reach(store_, deepest, corner, kTreeDepth - 3, new_cell,
                                            [this](NodeRef at) { structure::expand(store_, at); });
      if (new_cell) {
        fresh = markedOctants();
        return store_.createChildren(cell, static_cast<std::uint8_t>(fresh)).block;
      }
      structure::expand(store_, cell);
      region = store_.findRegion(corner);
    }
    fresh = markedOctants() & ~unsigned{region->mask[kTopOctet]};
    if (fresh != 0) store_.createNodes(region, kTopOctet, static_cast<std::uint8_t>(fresh));
    return region;
  }

  unsigned markedOctants() const {
    unsigned marked = 0;
    for (std::size_t t = 0; t < 8; ++t) marked |= unsigned{(hit_[t] | free_[t]) != 0} << t;
    return marked;
  }

  /// All cells have this value: drops the marks that would change nothing. False if none is left.
  bool keepUnsettled(float value) {
    bool left = false;
    for (std::size_t t = 0; t < 8; ++t) left |= keepUnsettled(value, t);
    return left;
  }
  bool keepUnsettled(float value, std::size_t t) {
    if (model_.settled(value, model_.hit)) hit_[t] = 0;
    if (model_.settled(value, model_.miss)) free_[t] = 0;
    return (hit_[t] | free_[t]) != 0;
  }

  /// Updates the marked cells under top node t. Returns its middle nodes with changed cells.
  std::uint8_t applyOctant(Block& region, std::size_t t, bool fresh) {
    if ((hit_[t] | free_[t]) == 0) return 0;
    const NodeRef top{&region, kTopSlot + static_cast<int>(t)};
    const int middles = childOctet(top.slot);
    const std::uint8_t& existing = region.mask[static_cast<std::size_t>(middles)];
    if (existing == 0 && !fresh) {
      if (!keepUnsettled(store_.node(top)->getLogOdds(), t)) return 0;
      structure::expand(store_, top);
    }
    const std::uint64_t marks = hit_[t] | free_[t];
    unsigned marked = 0;
    for (int i = 0; i < 8; ++i) marked |= unsigned{(marks >> (8 * i) & 0xff) != 0} << i;
    const unsigned missing = marked & ~unsigned{existing};
    if (missing != 0) store_.createNodes(&region, middles, static_cast<std::uint8_t>(missing));

    unsigned changed = 0;
    for (unsigned rest = marked; rest != 0; rest &= rest - 1) {
      const int i = std::countr_zero(rest);
      const NodeRef middle{&region, middles * 8 + i};
      if (applyCells(middle, missing >> i & 1, static_cast<std::uint8_t>(hit_[t] >> (8 * i)),
                     static_cast<std::uint8_t>(free_[t] >> (8 * i))))
        changed |= 1U << i;
    }
    return static_cast<std::uint8_t>(changed);
  }

  /// Updates the marked ones of eight cells. False if nothing changed.
  bool applyCells(NodeRef middle, bool fresh, std::uint8_t hit, std::uint8_t free) {
    const int octet = childOctet(middle.slot);
    const std::uint8_t& existing = middle.block->mask[static_cast<std::size_t>(octet)];
    if (existing == 0 && !fresh) {
      const float value = store_.node(middle)->getLogOdds();
      if (model_.settled(value, model_.hit)) hit = 0;
      if (model_.settled(value, model_.miss)) free = 0;
      if ((hit | free) == 0) return false;
      structure::expand(store_, middle);
    }
    const unsigned marked = hit | free;
    const unsigned missing = marked & ~unsigned{existing};
    NODE* cells = missing != 0 ? store_.createNodes(middle.block, octet, static_cast<std::uint8_t>(missing))
                               : store_.octet(middle.block, octet).nodes;
    bool changed = missing != 0;
    for (unsigned rest = marked; rest != 0; rest &= rest - 1) {
      const int i = std::countr_zero(rest);
      const float update = hit >> i & 1 ? model_.hit : model_.miss;
      const float value = cells[i].getLogOdds();
      if (!(missing >> i & 1) && model_.settled(value, update)) continue;
      cells[i].setLogOdds(model_.updated(value, update));
      changed = true;
    }
    return changed;
  }

  /// Prunes or recomputes what lies above the changed cells: middle nodes, top nodes, and the way up to the root.
  void summarise(Block& region, const std::array<std::uint8_t, 8>& changed) {
    NodeRef top;
    for (int t = 0; t < 8; ++t) {
      const unsigned middles = changed[static_cast<std::size_t>(t)];
      if (middles == 0) continue;
      NodeRef middle;
      for (unsigned rest = middles; rest != 0; rest &= rest - 1) {
        middle = {&region, kMiddleSlot + 8 * t + std::countr_zero(rest)};
        structure::summarise(store_, middle, {&region, firstCell(middle.slot)});
      }
      top = {&region, kTopSlot + t};
      structure::summarise(store_, top, middle);
    }
    structure::summariseAbove(store_, top);
  }

  BlockStore<NODE>& store_;
  SensorModel model_;
  bool lazy_;
  std::array<std::uint64_t, 8> hit_, free_;  // of the region at hand; no cell is in both
};

}  // namespace rhmap
