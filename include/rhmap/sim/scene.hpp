// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "rhmap/sim/labels.hpp"
#include "rhmap/sim/shape.hpp"
#include "rhmap/sim/terrain.hpp"
#include "rhmap/sim/track.hpp"

namespace rhmap::sim {

/// A shape in the frame of its object.
struct Part {
  Shape shape;
  Eigen::Vector3d centre{0, 0, 0};  ///< [m]
  double yaw = 0;                   ///< [rad]
};

/// A rigid thing that stands on the ground: its frame has x ahead, z up, and the origin on the ground.
struct Object {
  std::vector<Part> parts;
  Class resting = kUnlabelled;  ///< Class if it rests all the time.
  Class moving = kUnlabelled;   ///< Class if it moves at any time.
  bool tilts = false;           ///< Stands square to the ground, as vehicles do, and not upright.
  Track track{Stance{}};
  std::uint16_t instance = 0;  ///< From 1 on for things (vehicles, people), 0 for stuff.
};

/// A world in which a sensor is carried about. Its frame has z up and the ground below the start at z = 0.
struct Scene {
  std::string name;
  Terrain terrain;
  std::vector<Object> objects;
  Track ego{Stance{}};          ///< The carrier, on the ground.
  double sensor_height = 1.73;  ///< [m] above the ground, along the carrier's upright axis; KITTI's.
  double duration = 0;          ///< [s] for which things and carrier have something to do.

  /// Object to scene at a time [s].
  Eigen::Isometry3d objectPose(const Object& object, double time) const;

  /// Sensor to scene at a time [s]; x ahead, y left, z up.
  Eigen::Isometry3d sensorPose(double time) const;
};

/// Smallest radius [m] about an object's origin that holds all of its parts.
double boundingRadius(const Object& object);

}  // namespace rhmap::sim
