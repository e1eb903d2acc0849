// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "fast_angle.hpp"
#include "rhmap/removal/removal_config.hpp"
#include "scan_points.hpp"

namespace rhmap {

/// How a spinning LiDAR's directions become pixels: n columns of azimuth, and m rows, one a beam, from the top down.
/// Beams need not be equally far apart: each of many equal steps of elevation belongs to the row whose beam is nearest.
struct Projection {
  int rows = 0, columns = 0;
  float top = 0, bottom = 0;      ///< elevations of the first and the last step's middle [rad]
  std::vector<std::int32_t> row;  ///< of each step of elevation, never less than that of the step before

  int steps() const { return static_cast<int>(row.size()); }
  float stepsPerRadian() const { return static_cast<float>(steps() - 1) / (top - bottom); }
  /// May be outside of 0 ... steps() - 1.
  float stepOf(float x, float y, float z) const {
    return (top - fastAtan2(z, std::sqrt(x * x + y * y))) * stepsPerRadian() + 0.5F;
  }
  int columnOf(float x, float y) const {
    const float turn = fastAtan2(y, x) * (0.5F / kPi) + 0.5F;
    const int column = static_cast<int>(turn * static_cast<float>(columns));
    return column >= columns ? column - columns : column;
  }
};

/// Rows that are as many equal steps of elevation.
Projection evenProjection(int rows, int columns, float top, float bottom);

/// What the config says, and for what it does not say what the scan shows: the field of view is that of its points, the
/// steps are as far apart as points of one azimuth mostly are, rows are the steps that have points, and columns are no
/// narrower than from point to point.
Projection measureProjection(const RangeImageConfig& config, const ScanPoints& scan);

/// I^B_{m x n}: the nearest range of each pixel [m].
class RangeImage {
 public:
  static constexpr float kEmpty = std::numeric_limits<float>::infinity();

  RangeImage() = default;
  RangeImage(const Projection& projection, const ScanPoints& scan);

  const Projection& projection() const { return projection_; }

  /// Pixels, row by row, from the top.
  std::size_t size() const { return nearest_.size(); }
  /// kEmpty if a pixel shows nothing.
  float range(std::size_t pixel) const {
    return std::bit_cast<float>(static_cast<std::uint32_t>(nearest_[pixel] >> 32));
  }
  /// The point of the scan that a pixel shows; below 0: none.
  std::int32_t point(std::size_t pixel) const { return static_cast<std::int32_t>(nearest_[pixel]); }

  float at(int row, int column) const { return range(index(row, column)); }
  std::int32_t pointAt(int row, int column) const { return point(index(row, column)); }

 private:
  /// As one word, of which the smaller is the nearer: of equally near points the first.
  static std::uint64_t word(float range, std::int32_t point) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(range)} << 32 | static_cast<std::uint32_t>(point);
  }
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(projection_.columns) +
           static_cast<std::size_t>(column);
  }

  Projection projection_;
  std::vector<std::uint64_t> nearest_;  // word() of each pixel
};

}  // namespace rhmap
