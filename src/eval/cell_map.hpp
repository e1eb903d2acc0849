// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace rhmap::eval {

/// A cell of an endless grid.
struct Cell {
  std::int64_t x = 0, y = 0, z = 0;

  bool operator==(const Cell&) const = default;
};

/// Cells of one edge length [m], aligned to the origin as OctoMap's are.
class CellGrid {
 public:
  explicit CellGrid(double edge) : edge_(edge), factor_(1 / edge) {
    if (!(edge > 0) || !std::isfinite(factor_)) throw std::invalid_argument("the edge of a cell must be above 0");
  }

  double edge() const { return edge_; }

  /// Throws std::out_of_range for a point more than a million cells away, whose neighbours a float cannot tell apart.
  Cell cellOf(const octomap::point3d& point) const { return cellOf(point, 0); }

  /// The cell of the point moved by `shift` [m] along all three axes, without rounding to float.
  Cell cellOf(const octomap::point3d& point, double shift) const {
    return {along(point.x() + shift), along(point.y() + shift), along(point.z() + shift)};
  }

 private:
  std::int64_t along(double coordinate) const {
    const double cell = std::floor(coordinate * factor_);
    if (!(std::abs(cell) < kMost))
      throw std::out_of_range("a coordinate of " + std::to_string(coordinate) + " m is too far out for cells of " +
                              std::to_string(edge_) + " m");
    return static_cast<std::int64_t>(cell);
  }

  static constexpr double kMost = (1 << 20) - 64;  // 21 bits an axis in CellMap, and room for neighbours

  double edge_;
  double factor_;
};

/// Numbers cells 0, 1, 2 ... in the order in which they are first seen; open addressing, 12 bytes a slot.
class CellMap {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  CellMap() : keys_(64), ids_(64, kNone) {}

  std::uint32_t size() const { return size_; }

  std::uint32_t find(const Cell& cell) const { return ids_[slotOf(pack(cell))]; }

  std::uint32_t findOrAdd(const Cell& cell) {
    if (2 * (static_cast<std::size_t>(size_) + 1) > keys_.size()) grow();
    const std::uint64_t key = pack(cell);
    const std::size_t slot = slotOf(key);
    if (ids_[slot] == kNone) {
      keys_[slot] = key;
      ids_[slot] = size_++;
    }
    return ids_[slot];
  }

 private:
  static std::uint64_t pack(const Cell& cell) {
    constexpr std::int64_t kShift = 1 << 20;
    return static_cast<std::uint64_t>(cell.x + kShift) << 42 | static_cast<std::uint64_t>(cell.y + kShift) << 21 |
           static_cast<std::uint64_t>(cell.z + kShift);
  }

  std::size_t slotOf(std::uint64_t key) const {
    const std::size_t mask = keys_.size() - 1;
    std::uint64_t hash = key * 0x9e3779b97f4a7c15ULL;  // Fibonacci hashing; the upper bits are the mixed ones
    std::size_t slot = static_cast<std::size_t>(hash >> 32) & mask;
    while (ids_[slot] != kNone && keys_[slot] != key) slot = (slot + 1) & mask;
    return slot;
  }

  void grow() {
    CellMap larger;
    larger.keys_.assign(2 * keys_.size(), 0);
    larger.ids_.assign(2 * keys_.size(), kNone);
    for (std::size_t slot = 0; slot < keys_.size(); ++slot) {
      if (ids_[slot] == kNone) continue;
      const std::size_t to = larger.slotOf(keys_[slot]);
      larger.keys_[to] = keys_[slot];
      larger.ids_[to] = ids_[slot];
    }
    keys_.swap(larger.keys_);
    ids_.swap(larger.ids_);
  }

  std::vector<std::uint64_t> keys_;
  std::vector<std::uint32_t> ids_;
  std::uint32_t size_ = 0;
};

}  // namespace rhmap::eval
