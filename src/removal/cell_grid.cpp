// SPDX-License-Identifier: BSD-3-Clause
#include "cell_grid.hpp"

namespace rhmap {

CellGrid CellGrid::eroded() const {
  CellGrid result(x0_, y0_, z0_, side_);
  for (int y = 1; y + 1 < side_; ++y) {
    for (int x = 1; x + 1 < side_; ++x) {
      std::uint64_t all = word(x, y);
      if (all == 0) continue;
      for (int dy = -1; dy <= 1; ++dy) all &= word(x - 1, y + dy) & word(x, y + dy) & word(x + 1, y + dy);
      result.word(x, y) = all & all << 1 & all >> 1;
    }
  }
  return result;
}

CellGrid CellGrid::erodedToOneSide() const {
  CellGrid result(x0_, y0_, z0_, side_);
  const auto upright = [](std::uint64_t cells) { return cells & cells << 1 & cells >> 1; };
  for (int y = 1; y + 1 < side_; ++y) {
    for (int x = 1; x + 1 < side_; ++x) {
      if (word(x, y) == 0) continue;
      const auto row = [&](int dy) { return word(x - 1, y + dy) & word(x, y + dy) & word(x + 1, y + dy); };
      const auto column = [&](int dx) { return word(x + dx, y - 1) & word(x + dx, y) & word(x + dx, y + 1); };
      const std::uint64_t along_x = row(0), along_y = column(0);
      result.word(x, y) = upright(along_x & row(-1)) | upright(along_x & row(1)) | upright(along_y & column(-1)) |
                          upright(along_y & column(1));
    }
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
