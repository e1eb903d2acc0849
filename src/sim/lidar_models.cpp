// SPDX-License-Identifier: BSD-3-Clause
// The elevation tables.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "rhmap/sim/lidar.hpp"

namespace rhmap::sim {

namespace {

constexpr std::array<int, 4> kModels{16, 32, 64, 128};

/// Uneven as in sensors of this kind: dense about the horizon.
constexpr std::array<double, 32> kThirtyTwo{15,     10.333, 7,      4.667,  3.333,  2.333,  1.667,   1.333,
                                            1,      0.667,  0.333,  0,      -0.333, -0.667, -1,      -1.333,
                                            -1.667, -2,     -2.333, -2.667, -3,     -3.333, -3.667,  -4,
                                            -4.667, -5.333, -6.148, -7.254, -8.843, -11.31, -15.639, -25};

/// Appends `count` angles from `high` down to `low`, both included.
void addEven(std::vector<double>& degrees, double high, double low, int count) {
  for (int i = 0; i < count; ++i) degrees.push_back(high + (low - high) * i / (count - 1));
}

}  // namespace

std::span<const int> lidarModels() { return kModels; }

std::vector<double> elevations(int beams) {
  std::vector<double> angles;
  switch (beams) {
    case 16:
      addEven(angles, 15, -15, 16);
      break;
    case 32:
      angles.assign(kThirtyTwo.begin(), kThirtyTwo.end());
      break;
    case 64:  // two blocks, the lower one coarser
      addEven(angles, 2, -8.33, 32);
      addEven(angles, -8.83, -24.8, 32);
      break;
    case 128:
      addEven(angles, 15, -25, 128);
      break;
    default:
      throw std::invalid_argument("elevations: " + std::to_string(beams) + " beams; one of: 16, 32, 64, 128");
  }
  for (double& angle : angles) angle *= std::numbers::pi / 180;
  return angles;
}

void validate(const LidarConfig& config) {
  const auto require = [](bool good, const char* message) {
    if (!good) throw std::invalid_argument(message);
  };
  require(std::find(kModels.begin(), kModels.end(), config.beams) != kModels.end(),
          "LidarConfig: beams is none of 16, 32, 64, 128");
  const double columns = 360 / config.azimuth_step;
  require(config.azimuth_step >= 0.01 && config.azimuth_step <= 90 && std::abs(columns - std::round(columns)) < 1e-6,
          "LidarConfig: azimuth_step is not a part of 360 degrees from 0.01 to 90");
  require(config.max_range > 0 && std::isfinite(config.max_range), "LidarConfig: max_range is not a length above 0");
  require(config.range_noise >= 0 && std::isfinite(config.range_noise), "LidarConfig: range_noise is not a length");
  require(config.drop_out >= 0 && config.drop_out <= 1, "LidarConfig: drop_out is not a probability");
}

}  // namespace rhmap::sim
