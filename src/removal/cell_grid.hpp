// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rhmap {

/// A cell by its place.
struct Cell {
  int x, y, z;
};

/// One bit for each cell of a window: a word of 64 cells in z for each of side x side places (x, y).
class CellGrid {
 public:
  CellGrid() = default;
  CellGrid(int x0, int y0, int z0, int side)
      : x0_(x0),
        y0_(y0),
        z0_(z0),
        side_(side),
        words_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0) {}

  /// Another window, all clear.
  void reset(int x0, int y0, int z0, int side) {
    x0_ = x0, y0_ = y0, z0_ = z0, side_ = side;
    words_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0);
  }

  /// The same window as another, all clear.
  void resetTo(const CellGrid& other) { reset(other.x0_, other.y0_, other.z0_, other.side_); }

  int x0() const { return x0_; }
  int y0() const { return y0_; }
  int z0() const { return z0_; }
  int side() const { return side_; }

  std::uint64_t& word(int x, int y) { return words_[static_cast<std::size_t>(y * side_ + x)]; }
  std::uint64_t word(int x, int y) const { return words_[static_cast<std::size_t>(y * side_ + x)]; }

  /// All words, row by row.
  std::uint64_t* data() { return words_.data(); }
  const std::uint64_t* data() const { return words_.data(); }

  /// By the cell's own coordinates; false outside.
  bool at(int x, int y, int z) const {
    x -= x0_, y -= y0_, z -= z0_;
    return x >= 0 && y >= 0 && x < side_ && y < side_ && z >= 0 && z < 64 && (word(x, y) >> z & 1) != 0;
  }
  void set(int x, int y, int z) {
    x -= x0_, y -= y0_, z -= z0_;
    if (x >= 0 && y >= 0 && x < side_ && y < side_ && z >= 0 && z < 64) word(x, y) |= std::uint64_t{1} << z;
  }

  /// Sets the cells between two that are set, one above and one below, but for those of another grid of the same
  /// window.
  void closeGaps(const CellGrid& except) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= words_[i] << 1 & words_[i] >> 1 & ~except.words_[i];
  }

  /// Sets those of the 26 cells around one that are set in another grid of the same window, and appends the new ones.
  void growInto(const CellGrid& other, const Cell& from, std::vector<Cell>& grown);

  bool empty() const {
    return std::all_of(words_.begin(), words_.end(), [](std::uint64_t word) { return word == 0; });
  }

  // Each in the memory of a grid that is no longer needed: to get half a megabyte takes longer than to fill it.
  /// The cells whose 26 neighbours are all set as well; none at the window's rim.
  CellGrid eroded(CellGrid memory) const;
  /// The cells whose neighbours are all set as well, but for those on one of the four sides.
  CellGrid erodedToOneSide(CellGrid memory) const;
  /// The cells that are set or next to one that is; what is set at the rim of the window does not spread.
  CellGrid dilated(CellGrid memory) const;

 private:
  int x0_ = 0, y0_ = 0, z0_ = 0, side_ = 0;
  std::vector<std::uint64_t> words_;
};

}  // namespace rhmap
