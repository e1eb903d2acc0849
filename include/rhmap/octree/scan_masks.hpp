// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "rhmap/core/block_index.hpp"
#include "rhmap/core/cell_word.hpp"
#include "rhmap/core/key.hpp"
#include "rhmap/core/large_piece.hpp"
#include "rhmap/core/prefetch.hpp"

namespace rhmap {

/// What one scan says about the 512 cells of one region; bits in Morton order, one word an octant.
struct alignas(64) RegionMasks {
  std::array<std::uint64_t, 8> free;  ///< crossed by a ray
  std::array<std::uint64_t, 8> hit;   ///< a ray ends here: wins over free
  std::uint64_t region;               ///< cell word >> 9

  OcTreeKey corner() const { return cell_word::toKey(region << 9); }
};

/// A scan as two masks a region: the set of cells that any ray crosses and the set of cells that any ray ends in.
/// Marking is an OR, so neither order nor repetition nor the number of threads matters.
class ScanMasks {
 public:
  /// For cells anywhere: regions are found by hashing.
  ScanMasks() = default;
  /// For cells between two keys, inclusive along each axis, and no others: regions are found through a table over that
  /// box, as long as it has a sane size.
  ScanMasks(const OcTreeKey& min, const OcTreeKey& max) : first_(cell_word::fromKey(min) >> 9) {
    const auto bits = [&](unsigned i) { return std::bit_width(static_cast<unsigned>((max[i] >> 3) - (min[i] >> 3))); };
    y_shift_ = bits(0);
    z_shift_ = y_shift_ + bits(1);
    const int table_bits = z_shift_ + bits(2);
    if (table_bits <= kLargestTableBits)
      table_.reset(static_cast<RegionMasks**>(std::calloc(std::size_t{1} << table_bits, sizeof(RegionMasks*))));
  }
  ScanMasks(ScanMasks&&) = default;
  ScanMasks& operator=(ScanMasks&&) = default;

  /// Forgets the marks; their memory is kept for those of another scan.
  void clear() {
    if (table_ != nullptr) forEachRegion([this](const RegionMasks& r) { inTable(r.region) = nullptr; });
    index_.reset();
    chunks_in_use_ = 0;
    used_ = 0;
  }

  /// Marks the cells `bits` of an octant (a cell word >> 6) as crossed.
  void markFree(std::uint64_t octant, std::uint64_t bits) { at(octant >> 3).free[octant & 7] |= bits; }
  void markFree(const OcTreeKey& key) {
    const std::uint64_t word = cell_word::fromKey(key);
    markFree(word >> 6, std::uint64_t{1} << (word & 63));
  }
  void markHit(const OcTreeKey& key) { markHit(cell_word::fromKey(key)); }
  void markHit(std::uint64_t cell) { at(cell >> 9).hit[cell >> 6 & 7] |= std::uint64_t{1} << (cell & 63); }

  /// Marks cells as hit, of a region that has no marks yet and will get no others, which is quicker.
  void appendHits(std::uint64_t region, const std::array<std::uint64_t, 8>& hit) { create(region).hit = hit; }

  /// Marks cells of a region.
  void mark(const RegionMasks& cells) {
    RegionMasks& to = at(cells.region);
    for (std::size_t i = 0; i < 8; ++i) {
      to.free[i] |= cells.free[i];
      to.hit[i] |= cells.hit[i];
    }
  }

  /// Adds what another thread has marked, in a set for cells of the same box.
  void merge(ScanMasks&& other) {
    if (chunks_in_use_ == 0) {
      *this = std::move(other);
      return;
    }
    // They are in another processor's cache, and what they are added to may be anywhere: ask for both in good time.
    constexpr std::size_t kAhead = 8;
    other.forEachChunk([this](std::span<const RegionMasks> chunk) {
      for (std::size_t i = 0; i < chunk.size(); ++i) {
        if (i + 3 * kAhead < chunk.size()) prefetchWhole(&chunk[i + 3 * kAhead]);
        if (table_ != nullptr) {
          if (i + 2 * kAhead < chunk.size()) __builtin_prefetch(&inTable(chunk[i + 2 * kAhead].region));
          if (i + kAhead < chunk.size())
            if (const RegionMasks* known = inTable(chunk[i + kAhead].region)) prefetchWhole(known);
        }
        mark(chunk[i]);
      }
    });
  }

  /// Number of regions with marks.
  std::size_t size() const {
    std::size_t size = used_;
    for (std::size_t c = 0; c + 1 < chunks_in_use_; ++c) size += sizeOf(c);
    return size;
  }

  /// Visits the regions in the order in which they were first marked.
  template <class F>
  void forEachRegion(F&& visit) const {
    forEachChunk([&](std::span<const RegionMasks> regions) {
      for (const RegionMasks& region : regions) visit(region);
    });
  }

  /// Visits the keys of all cells: free ones (those that are not hit) as (key, false), hit ones as (key, true).
  template <class F>
  void forEachCell(F&& visit) const {
    forEachRegion([&visit](const RegionMasks& r) {
      for (std::size_t octant = 0; octant < 8; ++octant) {
        const std::uint64_t base = r.region << 9 | octant << 6;
        for (std::uint64_t bits = r.free[octant] & ~r.hit[octant]; bits != 0; bits &= bits - 1)
          visit(cell_word::toKey(base | static_cast<unsigned>(std::countr_zero(bits))), false);
        for (std::uint64_t bits = r.hit[octant]; bits != 0; bits &= bits - 1)
          visit(cell_word::toKey(base | static_cast<unsigned>(std::countr_zero(bits))), true);
      }
    });
  }

 private:
  /// A small scan needs few; those of a large one are in large pages, because the marks of rays jump about in them.
  static constexpr std::size_t sizeOf(std::size_t chunk) {
    return chunk == 0 ? 256 : kLargePieceBytes / sizeof(RegionMasks);
  }

  template <class F>
  void forEachChunk(F&& visit) const {
    for (std::size_t c = 0; c < chunks_in_use_; ++c)
      visit(std::span<const RegionMasks>(chunks_[c].get(), c + 1 < chunks_in_use_ ? sizeOf(c) : used_));
  }

  static constexpr int kLargestTableBits = 22;

  RegionMasks& at(std::uint64_t region) {
    if (table_ == nullptr) return *index_.findOrInsert(region, [&] { return &create(region); });
    RegionMasks*& known = inTable(region);
    if (known == nullptr) known = &create(region);
    return *known;
  }

  RegionMasks*& inTable(std::uint64_t region) {
    const std::uint64_t offset = region - first_;  // no axis borrows from the next: none is below the box
    return table_[(offset & 0x1fff) | (offset >> 13 & 0x1fff) << y_shift_ | offset >> 26 << z_shift_];
  }

  RegionMasks& create(std::uint64_t region) {
    if (chunks_in_use_ == 0 || used_ == sizeOf(chunks_in_use_ - 1)) {
      if (chunks_in_use_ == chunks_.size()) {
        chunks_.reserve(chunks_.size() + 1);
        chunks_.emplace_back(static_cast<RegionMasks*>(allocateLargePiece(!chunks_.empty())));
      }
      ++chunks_in_use_;
      used_ = 0;
    }
    RegionMasks& fresh = chunks_[chunks_in_use_ - 1][used_++];
    fresh = RegionMasks{{}, {}, region};
    return fresh;
  }

  struct Free {
    void operator()(RegionMasks** p) const { std::free(p); }
  };

  std::uint64_t first_ = 0;  // region at the table's start
  int y_shift_ = 0;
  int z_shift_ = 0;
  std::unique_ptr<RegionMasks*[], Free> table_;  // zeroed by calloc: pages that no ray reaches are never touched
  BlockIndex<RegionMasks> index_;
  struct FreePiece {
    void operator()(RegionMasks* p) const { freeLargePiece(p); }
  };
  std::vector<std::unique_ptr<RegionMasks[], FreePiece>> chunks_;
  std::size_t chunks_in_use_ = 0;
  std::size_t used_ = 0;  // of the last of them
};

}  // namespace rhmap
