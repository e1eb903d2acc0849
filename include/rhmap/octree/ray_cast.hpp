// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rhmap/core/cell_word.hpp"
#include "rhmap/octree/ray.hpp"

namespace rhmap {

/// A ray that is followed piece by piece: its way through a region is written down first and looked at then, so that
/// neither waits for the other at each cell.
struct RayCast {
  explicit RayCast(const Ray& ray);

  std::array<double, 3> t_max, t_delta;  ///< as in Ray
  std::uint64_t mirror = 0;              ///< as in RayBatch: all steps go up
  std::uint64_t mirrored;                ///< the current cell, in the mirror
  double entry = 0;                      ///< distance along the ray at which it came to this cell [m]
  bool in_space = true;                  ///< false: this is the last cell before the border of the key space

  /// The current cell, as a cell word.
  std::uint64_t cell() const { return mirrored ^ mirror; }
  /// The cells that it came to before, since it was last followed on; if that was through a region.
  std::span<const std::uint64_t> passed() const { return {path.data(), size}; }

  std::array<std::uint64_t, 3 * 7 + 1> path;
  std::size_t size = 0;
};

/// Follows a ray until it has left the cube of 2^bits cells an edge (as the tree is divided) that it is in, or has
/// entered a cell farther than `limit` [m], or is at the border of the key space. With `bits` 0 it is the region that
/// is left, and the path is written down. The steps are those of Ray::advance(), to the last bit.
void followRay(RayCast& ray, int bits, double limit);

}  // namespace rhmap
