// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rhmap/core/prefetch.hpp"
#include "rhmap/octree/parallel.hpp"
#include "rhmap/octree/region_update.hpp"
#include "rhmap/octree/scan_masks.hpp"
#include "rhmap/octree/structure.hpp"
#include "rhmap/octree/upward_pass.hpp"

namespace rhmap {

/// Puts a marked scan into the map: the same nodes and values as OctoMap's updateNode for every cell, but region by
/// region, with every node visited once. The map does not depend on the number of threads.
template <class NODE>
class ScanApplier {
 public:
  ScanApplier(BlockStore<NODE>& store, const SensorModel& model, bool lazy)
      : store_(store), model_(model), lazy_(lazy) {}

  void apply(const ScanMasks& masks, int num_threads) {
    // One thread makes the blocks, all update what is in them, one goes up from there.
    regions_.reserve(masks.size());
    masks.forEachRegion([this](const RegionMasks& marks) { regions_.push_back({.marks = &marks}); });
    for (std::size_t i = 0; i < regions_.size(); ++i) {
      if (i + kAhead < regions_.size()) store_.prefetchRegion(regions_[i + kAhead].marks->corner());
      regions_[i].block = open(*regions_[i].marks);
    }
    std::erase_if(regions_, [](const Region& region) { return region.block == nullptr; });
    const auto threads = static_cast<std::size_t>(std::max(num_threads, 1));
    auto editors = store_.editors(threads, regions_.size());
    forEachPart((regions_.size() + kPart - 1) / kPart, threads, [&](std::size_t part, std::size_t thread) {
      updatePart(std::span(regions_).subspan(part * kPart).first(std::min(kPart, regions_.size() - part * kPart)),
                 editors[thread]);
    });
    for (const auto& editor : editors) store_.takeOver(editor);
    close();
  }

 private:
  static constexpr std::size_t kAhead = 24;  // regions that are looked up while more are asked for
  static constexpr std::size_t kPart = 256;  // regions that a thread takes at a time

  struct Region {
    const RegionMasks* marks;
    Block* block = nullptr;
    NodeRef above{};          // the cell above it, once it has changed
    bool is_uniform = false;  // all of it is alike now, and becomes its parent
  };

  /// The block of a region, made if there is none; null if it needs none.
  Block* open(const RegionMasks& marks) {
    const OcTreeKey corner = marks.corner();
    Block* region = store_.findRegion(corner);
    return region != nullptr ? region : make(marks, corner);
  }

  /// Null if the region needs no block.
  Block* make(const RegionMasks& marks, const OcTreeKey& corner) {
    const NodeRef deepest = store_.deepest(corner);
    bool all_hit = true, all_free = true, any_hit = false, any_free = false;
    for (std::size_t t = 0; t < 8; ++t) {
      const std::uint64_t free = marks.free[t] & ~marks.hit[t];
      all_hit = all_hit && marks.hit[t] == ~std::uint64_t{0};
      all_free = all_free && free == ~std::uint64_t{0};
      any_hit = any_hit || marks.hit[t] != 0;
      any_free = any_free || free != 0;
    }
    if (deepest && !store_.hasChildren(deepest)) {
      const float value = store_.node(deepest)->getLogOdds();
      any_hit = any_hit && !model_.settled(value, model_.hit);
      any_free = any_free && !model_.settled(value, model_.miss);
      if (!any_hit && !any_free) return nullptr;
    }
    bool is_new = false;
    const NodeRef cell = structure::reach(store_, deepest, corner, kTreeDepth - 3, is_new,
                                          [this](NodeRef at) { structure::expand(store_, at); });
    NODE* node = store_.node(cell);
    float after;
    if (RegionUpdate<NODE>::staysWhole(model_, lazy_, node->getLogOdds(), all_hit, all_free, after)) {
      node->setLogOdds(after);
      store_.touch(cell.block);
      up_.add(cell);
      return nullptr;
    }
    if (is_new) return store_.createBlockBelow(cell);
    structure::expand(store_, cell);
    return store_.findRegion(corner);
  }

  /// Updates the next region while the memory of those after it is on its way: first the blocks, then the nodes above
  /// the marked cells.
  void updatePart(std::span<Region> regions, RegionEditor<NODE>& editor) const {
    RegionUpdate<NODE> update[] = {{editor, model_, lazy_}, {editor, model_, lazy_}};
    for (std::size_t i = 0; i <= regions.size(); ++i) {
      if (i + 4 < regions.size()) prefetchWhole(regions[i + 4].block);
      if (i + 2 < regions.size()) prefetchAbove(editor, *regions[i + 2].block, *regions[i + 2].marks);
      if (i < regions.size()) update[i % 2].begin(*regions[i].block, *regions[i].marks);
      if (i > 0) finish(regions[i - 1], update[1 - i % 2]);
    }
  }

  /// Updates a region and the value of the cell above it, which is nobody else's.
  void finish(Region& region, RegionUpdate<NODE>& update) const {
    if (!update.finish()) return;
    region.above = store_.parent({region.block, kTopSlot});
    if (lazy_) return;
    region.is_uniform = structure::isUniform(store_, NodeRef{region.block, kTopOctet});
    if (!region.is_uniform) structure::recompute(*store_.node(region.above), store_.octet(region.block, kTopOctet));
  }

  /// Asks for the nodes above the marked cells of a region (see BlockIndex::prefetch).
  [[gnu::always_inline]] static void prefetchAbove(const RegionEditor<NODE>& editor, const Block& region,
                                                   const RegionMasks& marks) {
    __builtin_prefetch(editor.nodes(region, kTopOctet), 1);
    for (std::size_t top = 0; top < 8; ++top)
      if ((marks.hit[top] | marks.free[top]) != 0)
        __builtin_prefetch(editor.nodes(region, static_cast<int>(kMiddleOctet + top)), 1);
  }

  /// Prunes the regions that are all alike, and prunes or recomputes what lies above the changed ones.
  void close() {
    for (const Region& region : regions_) {
      if (!region.above) continue;
      store_.touch(region.block);
      if (lazy_) continue;
      if (region.is_uniform) {
        structure::collapse(store_, region.above, NodeRef{region.block, kTopOctet});
      } else {
        store_.touch(region.above.block);
      }
      up_.add(region.above);
    }
    if (!lazy_) up_.run();
  }

  BlockStore<NODE>& store_;
  SensorModel model_;
  bool lazy_;
  std::vector<Region> regions_;
  UpwardPass<NODE> up_{store_};
};

}  // namespace rhmap
