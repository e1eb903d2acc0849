// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/simulation.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "rhmap/sim/scenes.hpp"

namespace rhmap::sim {

namespace {

// Streams of random numbers under one seed; the scene has stream 0.
constexpr std::uint64_t kScanStream = std::uint64_t{1} << 32;
constexpr std::uint64_t kPoseStream = std::uint64_t{2} << 32;

void validate(const SimulationConfig& config, double duration) {
  if (config.frames == 0) throw std::invalid_argument("SimulationConfig: frames is 0");
  if (!(config.rate > 0) || !std::isfinite(config.rate))
    throw std::invalid_argument("SimulationConfig: rate is not above 0");
  if (!(config.pose_noise >= 0) || !std::isfinite(config.pose_noise))
    throw std::invalid_argument("SimulationConfig: pose_noise is not a length");
  const double most = std::floor(duration * config.rate + 1e-6);
  if (static_cast<double>(config.frames) > most) {
    std::ostringstream message;
    message << "the scene " << config.scene << " lasts " << duration << " s: at " << config.rate << " Hz at most "
            << static_cast<long long>(most) << " frames";
    throw std::invalid_argument(message.str());
  }
}

}  // namespace

Simulation::Simulation(const SimulationConfig& config) : config_(config), scene_(makeScene(config.scene, config.seed)) {
  validate(config.lidar);
  validate(config, scene_.duration);
  // Up to the end of the last turn, so that one scan is a sequence, too.
  const double end = static_cast<double>(config.frames) / config.rate;
  for (const Object& object : scene_.objects) {
    const bool moves = object.moving != kUnlabelled && object.track.movesWithin(0, end);
    labels_.push_back(toLabel(moves ? object.moving : object.resting, object.instance));
  }
}

Eigen::Isometry3d Simulation::truePose(std::size_t k) const {
  if (k == 0) return Eigen::Isometry3d::Identity();
  return scene_.sensorPose(0).inverse() * scene_.sensorPose(time(k));
}

Eigen::Isometry3d Simulation::toldPose(std::size_t k) const {
  Eigen::Isometry3d pose = truePose(k);
  if (k == 0 || config_.pose_noise == 0) return pose;  // scan 0 says where the world is
  Random random(config_.seed, kPoseStream + k);
  for (int axis = 0; axis < 3; ++axis) pose.translation()[axis] += config_.pose_noise * random.normal();
  return pose;
}

LidarScan Simulation::scan(std::size_t k) const {
  return scanScene(scene_, time(k), config_.lidar, labels_, Random(config_.seed, kScanStream + k));
}

}  // namespace rhmap::sim
