// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rhmap/sim/lidar.hpp"
#include "rhmap/sim/scene.hpp"

namespace rhmap::sim {

struct SimulationConfig {
  std::string scene = "street";  ///< One of scenes().
  std::size_t frames = 100;      ///< Scans; together no longer than the scene's duration.
  double rate = 10;              ///< Scans a second [Hz].
  std::uint64_t seed = 1;        ///< Of the scene's making and of all noise.
  double pose_noise = 0;         ///< Standard deviation of each coordinate of the poses told, but the first [m].
  LidarConfig lidar;
};

/// A sequence of scans of a scene, each point with the label of what it hit. Same configuration, same bits; scan k of a
/// longer sequence has the same points, though a thing that moves only later has another class.
class Simulation {
 public:
  /// Throws std::invalid_argument that names what is wrong.
  explicit Simulation(const SimulationConfig& config);

  std::size_t size() const { return config_.frames; }
  const Scene& scene() const { return scene_; }

  /// Labels of the scene's objects. As in SemanticKITTI, a thing that moves at any time of the sequence (seen or not)
  /// has its moving class all the time, and one that never does, though it could, has its resting class.
  const std::vector<std::uint32_t>& labels() const { return labels_; }

  /// When scan k is taken [s].
  double time(std::size_t k) const { return static_cast<double>(k) / config_.rate; }

  /// Sensor to world as a perfect localisation gives it: the world is the sensor's frame of scan 0.
  Eigen::Isometry3d truePose(std::size_t k) const;

  /// The same with the pose noise of the configuration.
  Eigen::Isometry3d toldPose(std::size_t k) const;

  LidarScan scan(std::size_t k) const;

 private:
  SimulationConfig config_;
  Scene scene_;
  std::vector<std::uint32_t> labels_;
};

}  // namespace rhmap::sim
