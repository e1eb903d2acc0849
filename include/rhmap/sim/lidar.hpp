// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rhmap/sim/random.hpp"
#include "rhmap/sim/scene.hpp"

namespace rhmap::sim {

/// What becomes of a beam that comes back from nowhere.
enum class NoReturns {
  kSkip,  ///< No point.
  kZero,  ///< A point at (0,0,0) without a class, as in some recordings.
};

/// A spinning LiDAR.
struct LidarConfig {
  int beams = 64;             ///< One of lidarModels(): rows of a scan.
  double azimuth_step = 0.2;  ///< [deg]; 360 is a whole number of steps.
  double max_range = 80;      ///< [m]
  double range_noise = 0.02;  ///< Standard deviation along the beam [m].
  double drop_out = 0.02;     ///< Probability that a return is lost.
  NoReturns no_returns = NoReturns::kSkip;
};

/// Throws std::invalid_argument that names the field.
void validate(const LidarConfig& config);

/// The numbers of beams that there are: 16, 32, 64, 128.
std::span<const int> lidarModels();

/// Angles above the horizon [rad], from the top beam down; std::invalid_argument for a number that is none of them.
std::vector<double> elevations(int beams);

/// One turn; the sensor is taken to stand still during it.
struct LidarScan {
  std::vector<std::array<float, 4>>
      points;                         ///< x y z [m] in the sensor frame, intensity 0 to 1; beam by beam from the top.
  std::vector<std::uint32_t> labels;  ///< One a point: that of the object or ground that the beam hit.
};

/// Scans the scene as it is at a time [s]; object i is seen as labels[i]. Noise comes from `random`.
LidarScan scanScene(const Scene& scene, double time, const LidarConfig& config, std::span<const std::uint32_t> labels,
                    Random random);

}  // namespace rhmap::sim
