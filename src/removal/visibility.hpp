// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "range_image.hpp"
#include "region_map.hpp"
#include "rhmap/octree/key_space.hpp"

namespace rhmap {

/// Where a cube of the map is in the sensor's frame.
class SensorView {
 public:
  SensorView(const KeySpace& keys, const octomap::pose6d& pose);

  /// A place in keys (a cube's centre is its key) in the sensor's frame [m].
  std::array<float, 3> operator()(float kx, float ky, float kz) const {
    const float x = kx - origin_[0], y = ky - origin_[1], z = kz - origin_[2];
    return {rows_[0][0] * x + rows_[0][1] * y + rows_[0][2] * z, rows_[1][0] * x + rows_[1][1] * y + rows_[1][2] * z,
            rows_[2][0] * x + rows_[2][1] * y + rows_[2][2] * z};
  }

  /// The sensor, in keys.
  const std::array<float, 3>& origin() const { return origin_; }

 private:
  std::array<float, 3> origin_{};
  std::array<std::array<float, 3>, 3> rows_{};  // of R^T, times the edge of a cube [m]
};

/// What a scan says about a place.
enum class Look : std::int8_t {
  kFilled = -1,      ///< something is there, or as near as pixels can tell
  kUnknown = 0,      ///< hidden, outside of the image, or too near to a surface to tell
  kSeenThrough = 1,  ///< what is seen lies behind it
  kSkimmed = 2,      ///< the same, unless a surface runs on along the line of sight, as a roof may
};

/// What a scan says about cubes of an octant; it does not know the others.
struct CubeLooks {
  std::uint64_t filled = 0;
  std::uint64_t seen_through = 0;
  std::uint64_t skimmed = 0;
};

/// Looks at cubes through a scan's range image.
class Visibility {
 public:
  /// `cube`: edge of a cube [m].
  Visibility(const RangeImage& image, const ScanPoints& scan, const VisibilityConfig& config, double cube);

  /// At a place in the sensor's frame, a cube's centre [m].
  Look at(const std::array<float, 3>& p) const;

  /// At many cubes: `looks` is as long as `places`.
  void look(const SensorView& view, std::span<const CubesAt> places, std::span<CubeLooks> looks) const;

  /// True if no cube within `radius` [m] of a place (sensor's frame) can be seen through: nothing that is seen around
  /// it lies behind.
  bool hides(const std::array<float, 3>& p, float radius) const;

 private:
  struct Window {
    std::int8_t up, beside;  // in steps of elevation and columns
  };
  Look at(const std::array<float, 3>& p, float range, std::int32_t pixel) const;
  Look around(const std::array<float, 3>& p, float range, std::int32_t pixel) const;

  static constexpr float kFirstBeam = 0.75F;  // steps from the image's upper edge; a beam's elevation wavers
  static constexpr float kStepsPerMetre = 4;
  static constexpr int kSmallestBlock = 4;  // pixels of an edge
  /// The farthest range in blocks of pixels and those around them; 0 where all are empty.
  struct Farthest {
    int block, rows, columns;
    std::vector<float> ranges;
  };
  void summarise(const Farthest& own);

  Projection projection_;
  std::vector<float> ranges_;
  std::unique_ptr<std::array<float, 3>[]> points_;  // of the pixels that show one: sensor's frame [m]
  std::vector<Farthest> farthest_;                  // blocks of 4, 8, 16 ... pixels
  std::vector<int> middle_;                         // the step in the middle of each row
  std::vector<Window> windows_;                     // for cubes so many steps away; beyond: the last
  float behind_, before_, aside_, aside_share_, surface_, surface_share_, clearance_, skim_, skim_from_, edge_;
  int least_up_;  // rows of a window on each side
};

}  // namespace rhmap
