// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "rhmap/core/cell_word.hpp"
#include "rhmap/octree/lane.hpp"
#include "rhmap/octree/ray_cast.hpp"

namespace rhmap {

/// A RayCast on its way, in registers. Its steps are those of Ray::advance(Ray::nextAxis()), to the last bit, but
/// without branches: which axis is next is anybody's guess. They do not stop at the border of the key space.
template <class LANE = Lane>
class RaySteps {
 public:
  explicit RaySteps(const RayCast& ray)
      : tx_(ray.t_max[0]),
        ty_(ray.t_max[1]),
        tz_(ray.t_max[2]),
        dx_(ray.t_delta[0]),
        dy_(ray.t_delta[1]),
        dz_(ray.t_delta[2]),
        mirror_(ray.mirror),
        mirrored_(ray.mirrored) {}

  /// Distance along the ray at which it leaves the current cell [m].
  double exitDistance() const { return std::min({tx_.value(), ty_.value(), tz_.value()}); }

  /// To the next cell.
  void take() {
    const LANE x_before_y = less(tx_, ty_), x_before_z = less(tx_, tz_), y_before_z = less(ty_, tz_);
    const LANE x = x_before_y & x_before_z, y = without(y_before_z, x_before_y);  // where they tie: z before y before x
    tx_ = tx_ + (x & dx_);
    ty_ = ty_ + (y & dy_);
    tz_ = tz_ + without(dz_, x_before_z | y_before_z);

    constexpr std::uint64_t kX = cell_word::kAxis[0], kY = cell_word::kAxis[1], kZ = cell_word::kAxis[2];
    const std::uint64_t axis = kZ ^ (x.bits() & (kX ^ kZ)) ^ (y.bits() & (kY ^ kZ));
    mirrored_ = cell_word::advance(mirrored_, axis, 1);
  }

  /// The current cell, as a cell word; and in the mirror.
  std::uint64_t cell() const { return mirrored_ ^ mirror_; }
  std::uint64_t mirrored() const { return mirrored_; }

  /// Takes the ray to the current cell; `entry`, which nobody has kept, becomes greater than it is.
  void store(RayCast& ray) const {
    ray.t_max[0] = tx_.value();
    ray.t_max[1] = ty_.value();
    ray.t_max[2] = tz_.value();
    ray.mirrored = mirrored_;
    ray.entry = exitDistance();
  }

 private:
  LANE tx_, ty_, tz_;  // as in Ray
  const LANE dx_, dy_, dz_;
  const std::uint64_t mirror_;
  std::uint64_t mirrored_;
};

}  // namespace rhmap
