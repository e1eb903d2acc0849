// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rhmap::sim {

namespace {

using Eigen::Vector3d;

/// The part of a ray that is inside a convex solid; empty if first > last.
struct Span {
  double first = -kNoHit;
  double last = kNoHit;

  void cut(double from, double to) {
    first = std::max(first, from);
    last = std::min(last, to);
  }
};

constexpr Span kEmpty{kNoHit, -kNoHit};

/// Where origin + t * direction is within `half` of 0, for one axis.
Span slab(double origin, double direction, double half) {
  if (direction == 0) return std::abs(origin) <= half ? Span{} : kEmpty;
  const double a = (-half - origin) / direction;
  const double b = (half - origin) / direction;
  return {std::min(a, b), std::max(a, b)};
}

/// Where a t^2 + 2 b t + c <= 0, for a >= 0.
Span insideQuadric(double a, double b, double c) {
  if (a == 0) return c <= 0 ? Span{} : kEmpty;  // then b is 0, too: the ray runs along the axis
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return kEmpty;
  const double root = std::sqrt(discriminant);
  return {(-b - root) / a, (-b + root) / a};
}

Span sphere(const Vector3d& origin, const Vector3d& direction, double radius) {
  return insideQuadric(direction.squaredNorm(), origin.dot(direction), origin.squaredNorm() - radius * radius);
}

Span tube(const Vector3d& origin, const Vector3d& direction, double radius) {
  return insideQuadric(direction.head<2>().squaredNorm(), origin.head<2>().dot(direction.head<2>()),
                       origin.head<2>().squaredNorm() - radius * radius);
}

double entry(const Span& inside) {
  if (inside.first > inside.last || inside.last < 0) return kNoHit;
  return std::max(inside.first, 0.0);
}

double hit(const Box& box, const Vector3d& origin, const Vector3d& direction) {
  Span inside;
  for (int axis = 0; axis < 3; ++axis) {
    const Span part = slab(origin[axis], direction[axis], box.half[axis]);
    inside.cut(part.first, part.last);
  }
  return entry(inside);
}

double hitTube(double radius, double half_height, const Vector3d& origin, const Vector3d& direction) {
  Span inside = tube(origin, direction, radius);
  const Span part = slab(origin.z(), direction.z(), half_height);
  inside.cut(part.first, part.last);
  return entry(inside);
}

double hit(const Cylinder& cylinder, const Vector3d& origin, const Vector3d& direction) {
  return hitTube(cylinder.radius, cylinder.half_height, origin, direction);
}

/// The union of a cylinder and the spheres at its ends.
double hit(const Capsule& capsule, const Vector3d& origin, const Vector3d& direction) {
  const Vector3d end(0, 0, capsule.half_axis);
  return std::min({hitTube(capsule.radius, capsule.half_axis, origin, direction),
                   entry(sphere(origin - end, direction, capsule.radius)),
                   entry(sphere(origin + end, direction, capsule.radius))});
}

/// A unit sphere after scaling; the parameter of the ray stays the distance.
double hit(const Ellipsoid& ellipsoid, const Vector3d& origin, const Vector3d& direction) {
  return entry(sphere(origin.cwiseQuotient(ellipsoid.radii), direction.cwiseQuotient(ellipsoid.radii), 1));
}

Vector3d extent(const Box& box) { return box.half; }
Vector3d extent(const Cylinder& cylinder) { return {cylinder.radius, cylinder.radius, cylinder.half_height}; }
Vector3d extent(const Capsule& capsule) { return {capsule.radius, capsule.radius, capsule.half_axis + capsule.radius}; }
Vector3d extent(const Ellipsoid& ellipsoid) { return ellipsoid.radii; }

}  // namespace

double hitDistance(const Shape& shape, const Vector3d& origin, const Vector3d& direction) {
  return std::visit([&](const auto& solid) { return hit(solid, origin, direction); }, shape);
}

Vector3d halfExtent(const Shape& shape) {
  return std::visit([](const auto& solid) { return extent(solid); }, shape);
}

}  // namespace rhmap::sim
