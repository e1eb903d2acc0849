// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "rhmap/sim/scene.hpp"
#include "rhmap/sim/shape.hpp"

namespace rhmap::sim::test {

// Signed distances [m], negative inside: another way to say what the shapes are, to hold the rays against.

inline double surfaceDistance(const Box& box, const Eigen::Vector3d& point) {
  const Eigen::Vector3d over = point.cwiseAbs() - box.half;
  return over.cwiseMax(0).norm() + std::min(over.maxCoeff(), 0.0);
}

inline double surfaceDistance(const Cylinder& cylinder, const Eigen::Vector3d& point) {
  const Eigen::Vector2d over(point.head<2>().norm() - cylinder.radius, std::abs(point.z()) - cylinder.half_height);
  return over.cwiseMax(0).norm() + std::min(over.maxCoeff(), 0.0);
}

inline double surfaceDistance(const Capsule& capsule, const Eigen::Vector3d& point) {
  const double z = std::clamp(point.z(), -capsule.half_axis, capsule.half_axis);
  return (point - Eigen::Vector3d(0, 0, z)).norm() - capsule.radius;
}

/// Right in sign only, and for spheres.
inline double surfaceDistance(const Ellipsoid& ellipsoid, const Eigen::Vector3d& point) {
  return (point.cwiseQuotient(ellipsoid.radii).norm() - 1) * ellipsoid.radii.minCoeff();
}

inline double surfaceDistance(const Shape& shape, const Eigen::Vector3d& point) {
  return std::visit([&](const auto& solid) { return surfaceDistance(solid, point); }, shape);
}

/// Of a point in the object's frame to the union of its parts.
inline double surfaceDistance(const Object& object, const Eigen::Vector3d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Part& part : object.parts) {
    const Eigen::Vector3d local = Eigen::AngleAxisd(-part.yaw, Eigen::Vector3d::UnitZ()) * (point - part.centre);
    nearest = std::min(nearest, surfaceDistance(part.shape, local));
  }
  return nearest;
}

}  // namespace rhmap::sim::test
