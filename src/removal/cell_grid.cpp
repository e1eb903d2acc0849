// SPDX-License-Identifier: BSD-3-Clause
#include "cell_grid.hpp"

namespace rhmap {

CellGrid CellGrid::eroded() const {
  CellGrid result(x0_, y0_, z0_, side_);
  const auto side = static_cast<std::size_t>(side_);
  // Without branches, so that the loops become vector code.
  std::vector<std::uint64_t> along_y(side);
  for (std::size_t y = 1; y + 1 < side; ++y) {
    const std::uint64_t* row = &words_[y * side];
    for (std::size_t x = 0; x < side; ++x) {
      const std::uint64_t all = row[x - side] & row[x] & row[x + side];
      along_y[x] = all & all << 1 & all >> 1;
    }
    std::uint64_t* to = &result.words_[y * side];
    for (std::size_t x = 1; x + 1 < side; ++x) to[x] = along_y[x - 1] & along_y[x] & along_y[x + 1];
  }
  return result;
}

CellGrid CellGrid::dilated() const {
  CellGrid result(x0_, y0_, z0_, side_);
  for (int y = 1; y + 1 < side_; ++y) {
    for (int x = 1; x + 1 < side_; ++x) {
      std::uint64_t any = word(x, y);
      if (any == 0) continue;
      any |= any << 1 | any >> 1;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) result.word(x + dx, y + dy) |= any;
    }
  }
  return result;
}

}  // namespace rhmap
