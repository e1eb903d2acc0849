// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <type_traits>

#include "rhmap/core/region_editor.hpp"
#include "rhmap/octree/octet_update.hpp"
#include "rhmap/octree/scan_masks.hpp"
#include "rhmap/octree/structure.hpp"

namespace rhmap {

/// Puts the marks of one scan into regions: the same nodes and values as OctoMap's updateNode for every marked cell
/// and, unless it is lazy, pruning and inner values up to the region's eight top nodes. Every node is visited once.
template <class NODE>
class RegionUpdate {
 public:
  RegionUpdate(RegionEditor<NODE>& editor, const SensorModel& model, bool lazy)
      : editor_(editor), model_(model), lazy_(lazy) {}

  /// Makes what is missing above and around the marked cells, and asks for the cells' memory.
  void begin(Block& region, const RegionMasks& masks) {
    region_ = &region;
    count_ = 0;
    changed_ = 0;
    whole_ = 0;
    for (int top = 0; top < 8; ++top) {
      const std::uint64_t hit = masks.hit[static_cast<std::size_t>(top)];
      const std::uint64_t free = masks.free[static_cast<std::size_t>(top)] & ~hit;
      if ((hit | free) != 0) enter(region, top, hit, free);
    }
  }

  /// Updates the cells and what lies above them. False if nothing changed. Better some time after begin().
  bool finish() {
    const std::span octets(octets_.data(), count_);
    updateOctets(octets, model_);
    for (const OctetUpdate<NODE>& octet : octets) {
      changed_ |= std::uint64_t{octet.changed != 0} << octet.octet;
      if (octet.uniform && octet.changed != 0 && !lazy_) editor_.remove(*region_, octet.octet);
    }
    if (!lazy_)
      for (std::uint64_t tops = nonzeroBytes(changed_); tops != 0; tops &= tops - 1)
        summarise(*region_, std::countr_zero(tops) / 8);
    return changed_ != 0 || whole_ != 0;
  }

  /// The value that a leaf has after all cells in it were marked alike, so that it can stay one; false if it has to be
  /// expanded to find out.
  static bool staysWhole(const SensorModel& model, bool lazy, float before, bool all_hit, bool all_free, float& after) {
    if constexpr (!kIsPlain) return false;  // other nodes may hold what copying does not keep
    if (lazy || !(all_hit || all_free)) return false;
    after = model.updated(before, all_hit ? model.hit : model.miss);
    return after == after;  // NaN is equal to nothing and never pruned
  }

 private:
  static constexpr bool kIsPlain = std::is_same_v<NODE, OcTreeNode>;

  static std::uint8_t& mask(Block& region, int octet) { return region.mask[static_cast<std::size_t>(octet)]; }

  /// Goes down one top node: makes what is missing above and around the marked cells and notes the octets to update.
  void enter(Block& region, int top, std::uint64_t hit, std::uint64_t free) {
    const int middles = kMiddleOctet + top;
    const bool is_new = (mask(region, kTopOctet) >> top & 1) == 0;
    const bool has_middles = !is_new && mask(region, middles) != 0;
    if (!has_middles) {
      NODE* tops = is_new ? editor_.create(region, kTopOctet, 1U << top) : editor_.nodes(region, kTopOctet);
      const float value = tops[top].getLogOdds();
      if (!is_new && !keepUnsettled(value, hit, free)) return;
      float after;
      if (staysWhole(model_, lazy_, value, hit == ~std::uint64_t{0}, free == ~std::uint64_t{0}, after)) {
        tops[top].setLogOdds(after);
        whole_ |= 1U << top;
        return;
      }
      if (!is_new) expand(region, middles, tops[top]);
    }
    const std::uint64_t marks = hit | free, touched = nonzeroBytes(marks);
    const std::uint64_t existing = masksFrom(region, 8 * top), there = touched & nonzeroBytes(existing);
    if (there != 0) {
      NODE* parents = editor_.nodes(region, middles);
      const std::uint64_t after = existing | (marks & (there >> 7) * 0xff);
      if (kIsPlain && after != existing) editor_.claimEight(region, 8 * top, after & ~existing);
      for (std::uint64_t rest = there; rest != 0; rest &= rest - 1) {
        const int first = std::countr_zero(rest) & ~7, octet = 8 * top + first / 8;
        const auto of = [first](std::uint64_t word) { return static_cast<std::uint8_t>(word >> first); };
        NODE* cells = kIsPlain ? editor_.nodes(region, octet) : makeCells(region, octet, of(after), nullptr);
        note(octet, cells, parents + first / 8, of(hit), of(free), of(existing), of(after), 0);
      }
    }
    for (std::uint64_t rest = touched & ~there; rest != 0; rest &= rest - 1) {
      const int first = std::countr_zero(rest) & ~7;
      enter(region, top, first / 8, static_cast<std::uint8_t>(hit >> first), static_cast<std::uint8_t>(free >> first));
    }
  }

  /// The same for middle node `i` of a top node, which has no cells yet.
  void enter(Block& region, int top, int i, std::uint8_t hit, std::uint8_t free) {
    const int middles = kMiddleOctet + top;
    const int octet = 8 * top + i;
    const bool is_new = (mask(region, middles) >> i & 1) == 0;
    NODE* middle = (is_new ? editor_.create(region, middles, 1U << i) : editor_.nodes(region, middles)) + i;
    const float value = middle->getLogOdds();
    if (!is_new && !keepUnsettled(value, hit, free)) return;
    float whole;
    if (staysWhole(model_, lazy_, value, hit == 0xff, free == 0xff, whole)) {
      middle->setLogOdds(whole);
      changed_ |= std::uint64_t{1} << octet;
    } else if (is_new) {
      const auto after = static_cast<std::uint8_t>(hit | free);
      note(octet, makeCells(region, octet, after, nullptr), middle, hit, free, 0, after, 0);
    } else {
      note(octet, makeCells(region, octet, 0xff, middle), middle, hit, free, 0, 0xff, value);
    }
  }

  void note(int octet, NODE* cells, NODE* parent, std::uint8_t hit, std::uint8_t free, std::uint8_t existing,
            std::uint8_t after, float start) {
    __builtin_prefetch(cells, 1);
    OctetUpdate<NODE>& update = octets_[count_++];
    update.cells = cells;
    update.parent = lazy_ ? nullptr : parent;
    update.start = start;
    update.octet = static_cast<std::uint8_t>(octet);
    update.hit = hit;
    update.free = free;
    update.existing = existing;
    update.after = after;
  }

  /// All cells below a leaf have its value: drops the marks that would change nothing. False if none is left.
  template <class BITS>
  bool keepUnsettled(float value, BITS& hit, BITS& free) const {
    if (model_.settled(value, model_.hit)) hit = 0;
    if (model_.settled(value, model_.miss)) free = 0;
    return (hit | free) != 0;
  }

  void expand(Block& region, int octet, const NODE& from) {
    NODE* nodes = editor_.create(region, octet, 0xff);
    for (int i = 0; i < 8; ++i) nodes[i].copyData(from);
  }

  /// The cells of an octet, with those of `after` that are missing; copies of `leaf`, if that was one until now.
  NODE* makeCells(Block& region, int octet, std::uint8_t after, const NODE* leaf) {
    const std::uint8_t existing = mask(region, octet);
    const unsigned missing = after & ~unsigned{existing};
    if (missing == 0) return editor_.nodes(region, octet);
    if constexpr (kIsPlain) return editor_.claim(region, octet, missing);  // updateOctets() will write the values
    NODE* cells = editor_.create(region, octet, missing);
    if (existing == 0 && leaf != nullptr)
      for (int i = 0; i < 8; ++i) cells[i].copyData(*leaf);
    return cells;
  }

  /// Prunes or recomputes a top node.
  void summarise(Block& region, int top) {
    const int middles = kMiddleOctet + top;
    const Octet<NODE> children{editor_.nodes(region, middles), mask(region, middles)};
    NODE& node = editor_.nodes(region, kTopOctet)[top];
    bool uniform = children.mask == 0xff && masksFrom(region, 8 * top) == 0;
    for (int i = 1; i < 8 && uniform; ++i) uniform = children.nodes[i] == children.nodes[0];
    if (uniform) {
      node.copyData(children.nodes[0]);
      editor_.remove(region, middles);
    } else {
      structure::recompute(node, children);
    }
  }

  RegionEditor<NODE>& editor_;
  SensorModel model_;
  bool lazy_;
  Block* region_ = nullptr;
  unsigned whole_ = 0;         // top nodes that have changed and stayed leaves
  std::uint64_t changed_ = 0;  // middle nodes that have, or that have cells that have
  std::size_t count_ = 0;
  std::array<OctetUpdate<NODE>, kMiddleOctet> octets_;
};

}  // namespace rhmap
