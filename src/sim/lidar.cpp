// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/lidar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace rhmap::sim {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

/// A part of an object as the sensor sees it.
struct Target {
  const Shape* shape = nullptr;
  Isometry3d from_sensor;  ///< Sensor to shape frame.
  std::uint32_t label = 0;
  double nearest = 0;          ///< No point of it is nearer [m].
  double azimuth = 0;          ///< Of its centre [rad].
  double left = 0, right = 0;  ///< It is seen from azimuth - right to azimuth + left [rad].
};

struct Hit {
  double range = kNoHit;
  std::uint32_t label = kUnlabelled;
};

/// Share of light that comes back; a constant a class, for programs that look at intensities.
float reflectance(std::uint32_t label) {
  switch (label & 0xFFFFU) {
    case kRoad:
    case kParking:
      return 0.25f;
    case kVegetation:
    case kTerrain:
      return 0.35f;
    case kTrunk:
      return 0.3f;
    case kPole:
    case kFence:
      return 0.6f;
    default:
      return 0.45f;
  }
}

/// The azimuths under which a shape's box is seen: all of them if the sensor's axis goes through it.
void setAzimuths(Target& target, const Isometry3d& to_sensor) {
  const Vector3d half = halfExtent(*target.shape);
  const Vector3d centre = to_sensor.translation();
  target.azimuth = std::atan2(centre.y(), centre.x());
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const Vector3d point = to_sensor * half.cwiseProduct(signs);
    const double turn = std::remainder(std::atan2(point.y(), point.x()) - target.azimuth, 2 * kPi);
    target.left = std::max(target.left, turn);
    target.right = std::max(target.right, -turn);
  }
  if (target.left + target.right >= kPi - 1e-6) target.left = target.right = kPi;
}

/// All that is within range, the nearest first.
std::vector<Target> findTargets(const Scene& scene, double time, const LidarConfig& config,
                                std::span<const std::uint32_t> labels, const Isometry3d& sensor) {
  std::vector<Target> targets;
  const Isometry3d to_sensor = sensor.inverse();
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const double reach = config.max_range + boundingRadius(object);
    const Vector3d stand = object.track.at(time).position;
    if ((stand - sensor.translation()).head<2>().norm() > reach) continue;
    const Isometry3d object_to_sensor = to_sensor * scene.objectPose(object, time);
    for (const Part& part : object.parts) {
      const Isometry3d part_to_sensor =
          object_to_sensor * Eigen::Translation3d(part.centre) * Eigen::AngleAxisd(part.yaw, Vector3d::UnitZ());
      Target target;
      target.shape = &part.shape;
      target.nearest = part_to_sensor.translation().norm() - halfExtent(part.shape).norm();
      if (target.nearest > config.max_range) continue;
      target.from_sensor = part_to_sensor.inverse();
      target.label = labels[i];
      setAzimuths(target, part_to_sensor);
      targets.push_back(target);
    }
  }
  std::stable_sort(targets.begin(), targets.end(),
                   [](const Target& a, const Target& b) { return a.nearest < b.nearest; });
  return targets;
}

/// For each column the targets in it, the nearest first.
std::vector<std::vector<const Target*>> sortIntoColumns(const std::vector<Target>& targets, std::size_t num_columns) {
  std::vector<std::vector<const Target*>> columns(num_columns);
  const auto count = static_cast<long>(num_columns);
  const double step = 2 * kPi / static_cast<double>(num_columns);
  for (const Target& target : targets) {
    const long first = std::lround(std::floor((target.azimuth - target.right) / step - 1e-6));
    const long last = std::lround(std::ceil((target.azimuth + target.left) / step + 1e-6));
    for (long column = first; column <= last && column < first + count; ++column)
      columns[static_cast<std::size_t>((column % count + count) % count)].push_back(&target);
  }
  return columns;
}

Hit castBeam(const Scene& scene, const Isometry3d& sensor, const std::vector<const Target*>& targets,
             const Vector3d& direction, double max_range) {
  Hit hit;
  const Vector3d world_direction = sensor.linear() * direction;
  const double ground = scene.terrain.hitDistance(sensor.translation(), world_direction, max_range);
  const Target* seen = nullptr;
  hit.range = ground;
  for (const Target* target : targets) {
    if (target->nearest >= hit.range) break;
    const double range =
        hitDistance(*target->shape, target->from_sensor.translation(), target->from_sensor.linear() * direction);
    if (range >= hit.range) continue;
    hit.range = range;
    seen = target;
  }
  if (hit.range > max_range) return {};
  if (seen != nullptr) {
    hit.label = seen->label;
  } else {
    const Vector3d point = sensor.translation() + ground * world_direction;
    hit.label = scene.terrain.classAt(point.x(), point.y());
  }
  return hit;
}

}  // namespace

LidarScan scanScene(const Scene& scene, double time, const LidarConfig& config, std::span<const std::uint32_t> labels,
                    Random random) {
  validate(config);
  const std::vector<double> rows = elevations(config.beams);
  const auto num_columns = static_cast<std::size_t>(std::lround(360 / config.azimuth_step));
  const Isometry3d sensor = scene.sensorPose(time);
  const std::vector<Target> targets = findTargets(scene, time, config, labels, sensor);
  const auto columns = sortIntoColumns(targets, num_columns);
  const auto directionOf = [&](std::size_t row, std::size_t column) -> Vector3d {
    const double azimuth = 2 * kPi * static_cast<double>(column) / static_cast<double>(num_columns);
    const double flat = std::cos(rows[row]);
    return {flat * std::cos(azimuth), flat * std::sin(azimuth), std::sin(rows[row])};
  };

  LidarScan scan;
  scan.points.reserve(rows.size() * num_columns);
  scan.labels.reserve(rows.size() * num_columns);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t column = 0; column < num_columns; ++column) {
      const Vector3d direction = directionOf(row, column);
      const Hit hit = castBeam(scene, sensor, columns[column], direction, config.max_range);
      // Drawn for every beam, so that a beam's noise does not hang on what the others see.
      const bool lost = random.chance(config.drop_out);
      const double range = hit.range + config.range_noise * random.normal();
      if (hit.range == kNoHit || lost || range <= 0) {
        if (config.no_returns == NoReturns::kSkip) continue;
        scan.points.push_back({0, 0, 0, 0});
        scan.labels.push_back(kUnlabelled);
        continue;
      }
      const Eigen::Vector3f point = (range * direction).cast<float>();
      scan.points.push_back({point.x(), point.y(), point.z(), reflectance(hit.label)});
      scan.labels.push_back(hit.label);
    }
  }
  return scan;
}

}  // namespace rhmap::sim
