// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "range_image.hpp"
#include "rhmap/octree/key_space.hpp"

namespace rhmap {

/// Sees a cube of the map as the sensor does: its centre in the sensor's frame.
class SensorView {
 public:
  SensorView(const KeySpace& keys, const octomap::pose6d& pose);

  /// Sensor frame [m].
  std::array<float, 3> operator()(const OcTreeKey& cube) const {
    const float x = static_cast<float>(cube[0]) - origin_[0], y = static_cast<float>(cube[1]) - origin_[1],
                z = static_cast<float>(cube[2]) - origin_[2];
    return {rows_[0][0] * x + rows_[0][1] * y + rows_[0][2] * z, rows_[1][0] * x + rows_[1][1] * y + rows_[1][2] * z,
            rows_[2][0] * x + rows_[2][1] * y + rows_[2][2] * z};
  }

  /// The sensor, in keys: a cube's centre is its key.
  const std::array<float, 3>& origin() const { return origin_; }

 private:
  std::array<float, 3> origin_{};
  std::array<std::array<float, 3>, 3> rows_{};  // R^T, scaled to metres
};

/// Whether rays of a scan pass through a cube: every return in a window of pixels around it lies behind it, and there is
/// one.
class Visibility {
 public:
  Visibility(const RangeImage& image, const VisibilityConfig& config, double cube);

  /// A cube's centre in the sensor's frame [m].
  bool seesThrough(const std::array<float, 3>& p) const {
    const float row = projection_.rowOf(p[0], p[1], p[2]);
    if (!(row >= 0 && row < static_cast<float>(projection_.rows))) return false;
    const int column = projection_.columnOf(p[0], p[1]);
    const float range = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    const auto step = static_cast<std::size_t>(range * kStepsPerMetre);
    const std::vector<float>& nearest = windows_[step < windowOf_.size() ? windowOf_[step] : windows_.size() - 1];
    const float seen = nearest[static_cast<std::size_t>(static_cast<int>(row) * projection_.columns + column)];
    return seen > range + margin_ && seen < RangeImage::kEmpty;
  }

 private:
  static constexpr float kStepsPerMetre = 4;

  Projection projection_;
  std::vector<std::vector<float>> windows_;  // the nearest range around each pixel, from large windows to small ones
  std::vector<std::uint8_t> windowOf_;       // which of them for cubes this many steps away; beyond: the last
  float margin_;
};

}  // namespace rhmap
