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

/// One bit for each cell of a window: a word of 64 cells in z for each of side x side places (x, y); the side is a
/// multiple of 8. A scan touches little of it: eight words in a row are noted as touched, and the others are not looked
/// at again, neither to find what is set nor to clear it.
class CellGrid {
 public:
  CellGrid() = default;
  CellGrid(int x0, int y0, int z0, int side) { reset(x0, y0, z0, side); }

  /// Another window, all clear.
  void reset(int x0, int y0, int z0, int side) {
    const bool is_as_large = side == side_;
    open(x0, y0, z0, side);
    if (is_whole_ || !is_as_large) {
      std::fill(words_.begin(), words_.end(), 0);
      std::fill(touched_.begin(), touched_.end(), std::uint8_t{0});
    } else {
      for (std::size_t i = 0; i < touched_.size(); ++i)
        if (touched_[i] != 0) std::fill_n(&words_[8 * i], 8, 0), touched_[i] = 0;
    }
    is_whole_ = false;
  }

  /// The same window as another, all clear.
  void resetTo(const CellGrid& other) { reset(other.x0_, other.y0_, other.z0_, other.side_); }

  int x0() const { return x0_; }
  int y0() const { return y0_; }
  int z0() const { return z0_; }
  int side() const { return side_; }

  std::uint64_t word(int x, int y) const { return words_[static_cast<std::size_t>(y * side_ + x)]; }
  /// The same, to be written to.
  std::uint64_t& touch(int x, int y) {
    const auto i = static_cast<std::size_t>(y * side_ + x);
    touched_[i / 8] = 1;
    return words_[i];
  }

  /// All words, row by row. Who writes to them may touch all.
  std::uint64_t* data() {
    is_whole_ = true;
    return words_.data();
  }
  const std::uint64_t* data() const { return words_.data(); }

  /// False if no cell is set at the places from (x, y) to (x + 7, y + 7), x and y being multiples of 8.
  bool mayHold(int x, int y) const {
    unsigned any = is_whole_;
    for (int row = y; row < y + 8; ++row) any |= touched_[static_cast<std::size_t>(row * side_ + x) / 8];
    return any != 0;
  }

  /// By the cell's own coordinates; false outside.
  bool at(int x, int y, int z) const {
    x -= x0_, y -= y0_, z -= z0_;
    return x >= 0 && y >= 0 && x < side_ && y < side_ && z >= 0 && z < 64 && (word(x, y) >> z & 1) != 0;
  }
  void set(int x, int y, int z) {
    x -= x0_, y -= y0_, z -= z0_;
    if (x >= 0 && y >= 0 && x < side_ && y < side_ && z >= 0 && z < 64) touch(x, y) |= std::uint64_t{1} << z;
  }

  /// Sets the cells between two that are set, one above and one below, but for those of another grid of the same
  /// window.
  void closeGaps(const CellGrid& except) {
    is_whole_ = true;
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= words_[i] << 1 & words_[i] >> 1 & ~except.words_[i];
  }

  /// Sets those of the 26 cells around one that are set in another grid of the same window, and appends the new ones.
  void growInto(const CellGrid& other, const Cell& from, std::vector<Cell>& grown);

  bool empty() const {
    for (std::size_t i = 0; i < words_.size(); ++i)
      if ((is_whole_ || touched_[i / 8] != 0) && words_[i] != 0) return false;
    return true;
  }

  // Each in the memory of a grid that is no longer needed: to get half a megabyte takes longer than to fill it.
  /// The cells whose 26 neighbours are all set as well; none at the window's rim.
  CellGrid eroded(CellGrid memory) const;
  /// The cells whose neighbours are all set as well, but for those on one of the four sides.
  CellGrid erodedToOneSide(CellGrid memory) const;
  /// The cells that are set or next to one that is; what is set at the rim of the window does not spread.
  CellGrid dilated(CellGrid memory) const;

 private:
  /// Another window, in which anything may be set.
  void open(int x0, int y0, int z0, int side) {
    x0_ = x0, y0_ = y0, z0_ = z0, side_ = side;
    words_.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    touched_.resize(words_.size() / 8);
  }
  /// The same for all of whose words but those at the rim are written next.
  void openInside(const CellGrid& other);

  int x0_ = 0, y0_ = 0, z0_ = 0, side_ = 0;
  std::vector<std::uint64_t> words_;
  std::vector<std::uint8_t> touched_;  // for eight words each: one of them may not be 0
  bool is_whole_ = false;              // so may any
};

}  // namespace rhmap
