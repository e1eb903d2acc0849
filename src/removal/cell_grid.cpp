// SPDX-License-Identifier: BSD-3-Clause
#include "cell_grid.hpp"

#include <bit>

namespace rhmap {
namespace {

/// The cells whose neighbours above and below are set as well.
std::uint64_t upright(std::uint64_t cells) { return cells & cells << 1 & cells >> 1; }

}  // namespace

// The loops below have no branches, so that they become vector code.

void CellGrid::openInside(const CellGrid& other) {
  open(other.x0_, other.y0_, other.z0_, other.side_);
  is_whole_ = true;
  const auto side = static_cast<std::size_t>(side_);
  std::fill_n(words_.begin(), side, 0);
  std::fill_n(words_.rbegin(), side, 0);
  for (std::size_t y = 1; y < side; ++y) words_[y * side - 1] = words_[y * side] = 0;
}

CellGrid CellGrid::eroded(CellGrid result) const {
  result.openInside(*this);
  const auto side = static_cast<std::size_t>(side_);
  std::vector<std::uint64_t> along_y(side);
  for (std::size_t y = 1; y + 1 < side; ++y) {
    const std::uint64_t* row = &words_[y * side];
    for (std::size_t x = 0; x < side; ++x) along_y[x] = upright(row[x - side] & row[x] & row[x + side]);
    std::uint64_t* to = &result.words_[y * side];
    for (std::size_t x = 1; x + 1 < side; ++x) to[x] = along_y[x - 1] & along_y[x] & along_y[x + 1];
  }
  return result;
}

CellGrid CellGrid::erodedToOneSide(CellGrid result) const {
  result.openInside(*this);
  const auto side = static_cast<std::size_t>(side_);
  std::vector<std::uint64_t> before(side), here(side), after(side), along_y(side);
  for (std::size_t y = 1; y + 1 < side; ++y) {
    const std::uint64_t* row = &words_[y * side];
    for (std::size_t x = 0; x < side; ++x) {
      before[x] = upright(row[x - side]), here[x] = upright(row[x]), after[x] = upright(row[x + side]);
      along_y[x] = before[x] & here[x] & after[x];
    }
    const auto along_x = [](const std::vector<std::uint64_t>& cells, std::size_t x) {
      return cells[x - 1] & cells[x] & cells[x + 1];
    };
    std::uint64_t* to = &result.words_[y * side];
    for (std::size_t x = 1; x + 1 < side; ++x)
      to[x] = (along_x(here, x) & (along_x(before, x) | along_x(after, x))) |
              (along_y[x] & (along_y[x - 1] | along_y[x + 1]));
  }
  return result;
}

void CellGrid::growInto(const CellGrid& other, const Cell& from, std::vector<Cell>& grown) {
  const int z = from.z - z0_;
  if (z < 0 || z >= 64) return;
  const std::uint64_t beside = std::uint64_t{1} << z, near = beside | beside << 1 | beside >> 1;
  for (int y = std::max(0, from.y - y0_ - 1); y <= std::min(side_ - 1, from.y - y0_ + 1); ++y) {
    for (int x = std::max(0, from.x - x0_ - 1); x <= std::min(side_ - 1, from.x - x0_ + 1); ++x) {
      const std::uint64_t fresh = near & other.word(x, y) & ~word(x, y);
      if (fresh == 0) continue;
      touch(x, y) |= fresh;
      for (std::uint64_t rest = fresh; rest != 0; rest &= rest - 1)
        grown.push_back({x + x0_, y + y0_, std::countr_zero(rest) + z0_});
    }
  }
}

CellGrid CellGrid::dilated(CellGrid result) const {
  result.resetTo(*this);
  for (int y = 1; y + 1 < side_; ++y) {
    for (int x = 1; x + 1 < side_; ++x) {
      std::uint64_t any = word(x, y);
      if (any == 0) continue;
      any |= any << 1 | any >> 1;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) result.touch(x + dx, y + dy) |= any;
    }
  }
  return result;
}

}  // namespace rhmap
