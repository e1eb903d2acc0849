// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rhmap/core/cell_word.hpp"
#include "rhmap/octree/ray.hpp"

namespace rhmap {

/// The next steps of a ray, taken before any of the cells is looked at: so that taking them waits for no memory, and
/// looking waits for no step.
struct RaySteps {
  static constexpr std::size_t kSteps = 8;

  std::array<std::uint64_t, kSteps> cells;          ///< to which each leads, as cell words
  std::array<std::array<double, kSteps>, 3> t_max;  ///< as in Ray, after each: apart, as they are written
  double entry;                                     ///< distance along the ray at which it comes to the last cell [m]
  unsigned ends;  ///< bit i: the next cell is in another region than cell i, or there is none
};

/// A ray that is followed piece by piece.
struct RayCast {
  explicit RayCast(const Ray& ray);

  alignas(32) std::array<double, 4> t_max, t_delta;  ///< as in Ray; the fourth fills a vector, and never comes
  std::uint64_t mirror = 0;                          ///< as in RayBatch: all steps go up
  std::uint64_t mirrored;                            ///< the current cell, in the mirror
  double entry = 0;                                  ///< distance along the ray at which it came to this cell [m]
  bool in_space = true;  ///< false: this is the last cell before the border of the key space

  /// The current cell, as a cell word.
  std::uint64_t cell() const { return mirrored ^ mirror; }
  /// True if the next RaySteps might lead across the border of the key space.
  bool isNearBorder() const {
    static_assert(RaySteps::kSteps <= 8);  // an edge of the last region, and no more
    const auto is_last = [this](int axis) {
      const std::uint64_t region = cell_word::kAxis[axis] & ~std::uint64_t{kCellsInBlock - 1};
      return (mirrored & region) == region;
    };
    return is_last(0) || is_last(1) || is_last(2);
  }
  /// Follows the first steps, up to number `last`; `entry` may become greater than it is.
  void follow(const RaySteps& steps, std::size_t last) {
    for (std::size_t axis = 0; axis < 3; ++axis) t_max[axis] = steps.t_max[axis][last];
    mirrored = steps.cells[last] ^ mirror;
    entry = steps.entry;
  }
};

/// The steps are those of Ray::advance(), to the last bit.
void takeSteps(const RayCast& ray, RaySteps& steps);

/// Follows a ray until it has left the cube of 2^bits cells an edge (as the tree is divided; 3 or more) that it is in,
/// or has entered a cell farther than `limit` [m], or is at the border of the key space. The end is that of
/// Ray::advance(), to the last bit; most of the steps are not taken one after the other.
void leaveCube(RayCast& ray, int bits, double limit);

/// Follows a ray to the next cell, unless it is at the border of the key space.
void step(RayCast& ray);

}  // namespace rhmap
