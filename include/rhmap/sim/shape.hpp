// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <variant>

namespace rhmap::sim {

// Solids about the origin of their own frame, z up; lengths in metres.

struct Box {
  Eigen::Vector3d half;  ///< Half of the edges.
};

struct Cylinder {
  double radius = 0;
  double half_height = 0;
};

/// All points within `radius` of a vertical line of 2 * half_axis.
struct Capsule {
  double radius = 0;
  double half_axis = 0;
};

struct Ellipsoid {
  Eigen::Vector3d radii;
};

using Shape = std::variant<Box, Cylinder, Capsule, Ellipsoid>;

constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// Distance [m] along a ray to where it meets the shape: 0 if it starts inside, kNoHit if it misses. `direction` has
/// length 1; both are in the frame of the shape.
double hitDistance(const Shape& shape, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

/// Half of the edges [m] of the smallest upright box about the shape.
Eigen::Vector3d halfExtent(const Shape& shape);

}  // namespace rhmap::sim
