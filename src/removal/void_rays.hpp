// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "cell_grid.hpp"

namespace rhmap {

/// Rays from one place, in cells, one column a coordinate.
struct VoidRays {
  std::vector<float> x, y, z;  ///< where they go
  std::vector<float> share;    ///< of each that is followed

  std::size_t size() const { return x.size(); }
  void clear() {
    x.clear(), y.clear(), z.clear();
    share.clear();
  }
  void push(const std::array<float, 3>& to, float followed) {
    x.push_back(to[0]), y.push_back(to[1]), z.push_back(to[2]);
    share.push_back(followed);
  }
};

/// Marks in `crossed` the cells on the rays' ways, of each up to the first cell that is in `hit` (a grid of the same
/// window): Amanatides and Woo, one ray a lane, with the same cells on every instruction set.
void followRays(const std::array<float, 3>& from, const VoidRays& rays, const CellGrid& hit, CellGrid& crossed);

}  // namespace rhmap
