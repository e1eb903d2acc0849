// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include <octomap/Pointcloud.h>

/// The same numbers on every run.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : state_(seed) {}

  /// 0 ... n - 1.
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>((std::uint64_t{next()} * n) >> 32); }
  float between(float low, float high) {
    return low + (high - low) * static_cast<float>(next() >> 8) / static_cast<float>(1 << 24);
  }
  octomap::point3d point(float reach) {
    const float x = between(-reach, reach), y = between(-reach, reach);
    return octomap::point3d(x, y, between(-reach, reach));
  }

 private:
  std::uint32_t next() {
    state_ = state_ * 1664525U + 1013904223U;
    return state_ ^ state_ >> 15;
  }
  std::uint32_t state_;
};

/// What a range finder sees in a room of 12 x 8 x 3 m.
inline octomap::Pointcloud roomScan(const octomap::point3d& origin, unsigned rays, Dice& dice) {
  octomap::Pointcloud scan;
  const float half[3] = {6.0F, 4.0F, 1.5F};
  for (unsigned i = 0; i < rays; ++i) {
    const octomap::point3d direction = dice.point(1.0F).normalized();
    float length = 50.0F;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const float wall = direction(axis) > 0 ? half[axis] : -half[axis];
      if (std::fabs(direction(axis)) > 1e-3F) length = std::fmin(length, (wall - origin(axis)) / direction(axis));
    }
    scan.push_back(origin + direction * (length + dice.between(-0.02F, 0.02F)));
  }
  return scan;
}
