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
  static constexpr double kNever = std::numeric_limits<double>::max();

  alignas(32) std::array<double, 4> t_max{0, 0, 0, kNever};  ///< as in Ray; the fourth fills a vector, and never comes
  alignas(32) std::array<double, 4> t_delta{0, 0, 0, kNever};
  std::uint64_t mirror;    ///< as in RayBatch: all steps go up
  std::uint64_t mirrored;  ///< the current cell, in the mirror
  double entry;            ///< distance along the ray at which it came to this cell [m]
  bool in_space;           ///< false: this is the last cell before the border of the key space

  /// The current cell, as a cell word.
  std::uint64_t cell() const { return mirrored ^ mirror; }
  /// So many steps do not lead across the border of the key space, along whichever axis.
  int stepsToBorder() const {
    const auto regions = [this](int shift) { return static_cast<int>(~mirrored >> shift & 0x1fff); };
    return 8 * std::min({regions(9), regions(22), regions(35)});
  }
};

/// Sets up OctoMap's castRay from `origin`, which lies in cell `key`, along a unit vector. False if the direction is
/// (0, 0, 0). Where the ray is to be, because a copy would have to wait for it: it is read in larger pieces than it was
/// written in.
bool startCast(const KeySpace& keys, const point3d& origin, const OcTreeKey& key, const point3d& direction,
               RayCast& ray);

/// Follows a ray until it has left the cube of 2^bits cells an edge (as the tree is divided; 3 or more) that it is in,
/// or has entered a cell farther than `limit` [m], or is at the border of the key space. The end is that of
/// Ray::advance(), to the last bit; most of the steps are not taken one after the other.
void leaveCube(RayCast& ray, int bits, double limit);

/// Follows a ray to the next cell, unless it is at the border of the key space.
void step(RayCast& ray);

}  // namespace rhmap
