// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "rhmap/core/cell_word.hpp"
#include "rhmap/octree/ray.hpp"

namespace rhmap {

/// A ray that is followed piece by piece.
struct RayCast {
  explicit RayCast(const Ray& ray) {
    constexpr double kNever = std::numeric_limits<double>::max();
    t_max = {ray.t_max[0], ray.t_max[1], ray.t_max[2], kNever};
    t_delta = {ray.t_delta[0], ray.t_delta[1], ray.t_delta[2], kNever};
    // Without branches: in which of eight directions a ray goes is anybody's guess.
    for (unsigned i = 0; i < 3; ++i) mirror |= cell_word::kAxis[i] & -std::uint64_t{ray.step[i] < 0};
    mirrored = cell_word::fromKey(ray.key) ^ mirror;
  }

  alignas(32) std::array<double, 4> t_max, t_delta;  ///< as in Ray; the fourth fills a vector, and never comes
  std::uint64_t mirror = 0;                          ///< as in RayBatch: all steps go up
  std::uint64_t mirrored;                            ///< the current cell, in the mirror
  double entry = 0;                                  ///< distance along the ray at which it came to this cell [m]
  bool in_space = true;  ///< false: this is the last cell before the border of the key space

  /// The current cell, as a cell word.
  std::uint64_t cell() const { return mirrored ^ mirror; }
  /// So many steps do not lead across the border of the key space, along whichever axis.
  int stepsToBorder() const {
    const auto regions = [this](int shift) { return static_cast<int>(~mirrored >> shift & 0x1fff); };
    return 8 * std::min({regions(9), regions(22), regions(35)});
  }
};

/// Follows a ray until it has left the cube of 2^bits cells an edge (as the tree is divided; 3 or more) that it is in,
/// or has entered a cell farther than `limit` [m], or is at the border of the key space. The end is that of
/// Ray::advance(), to the last bit; most of the steps are not taken one after the other.
void leaveCube(RayCast& ray, int bits, double limit);

/// Follows a ray to the next cell, unless it is at the border of the key space.
void step(RayCast& ray);

}  // namespace rhmap
