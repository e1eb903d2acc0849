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
  Visibility(const RangeImage& image, const ScanPoints& scan, const VisibilityConfig& config, double cube);

  /// A cube's centre in the sensor's frame [m].
  bool seesThrough(const std::array<float, 3>& p) const {
    const float row = projection_.rowOf(p[0], p[1], p[2]);
    if (!(row >= 0 && row < static_cast<float>(projection_.rows))) return false;
    const int column = projection_.columnOf(p[0], p[1]);
    const float range = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    const float behind = range + margin_;
    const int i = static_cast<int>(row);
    const float centre = ranges_[static_cast<std::size_t>(i * projection_.columns + column)];
    if (!(centre > behind)) return false;
    return isClear(i, column, range, p);
  }

 private:
  static constexpr float kStepsPerMetre = 4;
  struct Window {
    std::int8_t up, beside;
  };
  bool isClear(int row, int column, float range, const std::array<float, 3>& p) const;

  Projection projection_;
  std::vector<float> ranges_;
  std::vector<std::array<float, 3>> points_;
  float segment_;
  std::vector<Window> windows_;  // for cubes this many steps away; beyond: the last
  float margin_, near_;
  int min_seen_;
};

}  // namespace rhmap
