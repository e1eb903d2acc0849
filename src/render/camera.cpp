// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace rhmap::render {
namespace {

using Eigen::Vector3d;

constexpr double kMargin = 1.06;    ///< room around a box that is fitted
constexpr double kSmallest = 0.01;  ///< a box or a distance below this is taken as this [m]

std::vector<Vector3d> cornersOf(const Box& box) {
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i) corners.push_back(box.corner(static_cast<Box::CornerType>(i)));
  return corners;
}

double reach(const Box& box) { return std::max(box.diagonal().norm(), kSmallest); }

/// An orthographic camera that looks at the box from the direction `from`.
Camera fitOrthographic(const Box& box, const Vector3d& from, const Vector3d& up, double aspect) {
  Camera camera{.eye = box.center() + reach(box) * from, .target = box.center(), .up = up};
  const Eigen::Isometry3d view = viewOf(camera);
  double half_height = kSmallest;
  for (const Vector3d& corner : cornersOf(box)) {
    const Vector3d seen = view * corner;
    half_height = std::max({half_height, std::abs(seen.y()), std::abs(seen.x()) / aspect});
  }
  camera.view_height = 2 * kMargin * half_height;
  return camera;
}

/// The place at this length along the path.
Vector3d placeAt(std::span<const Vector3d> path, double length) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step = (path[i] - path[i - 1]).norm();
    if (length <= step && step > 0) return path[i - 1] + length / step * (path[i] - path[i - 1]);
    length -= step;
  }
  return path.back();
}

}  // namespace

Camera topView(const Box& box, double aspect) {
  return fitOrthographic(box, Vector3d::UnitZ(), Vector3d::UnitY(), aspect);
}

Camera isometricView(const Box& box, double aspect) {
  return fitOrthographic(box, Vector3d(-1, -1, 1).normalized(), Vector3d::UnitZ(), aspect);
}

Camera orbitView(const Box& box, double azimuth, double elevation, double aspect) {
  const Vector3d from(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                      std::sin(elevation));
  Camera camera{.eye = box.center() + from, .target = box.center()};
  const Eigen::Isometry3d to_world = viewOf(camera).inverse();
  const double tan_vertical = std::tan(0.5 * camera.field_of_view);
  // What is near looks larger, so the middle of the box is not the middle of its picture: move sideways until it is.
  for (int round = 0; round < 10; ++round) {
    double distance = kSmallest;
    const Eigen::Matrix3d to_camera = to_world.linear().transpose();
    for (const Vector3d& corner : cornersOf(box)) {
      const Vector3d seen = to_camera * (corner - camera.target);  // z: towards the eye
      const double across = std::max(std::abs(seen.y()), std::abs(seen.x()) / aspect);
      distance = std::max(distance, seen.z() + kMargin * across / tan_vertical);
    }
    Eigen::AlignedBox2d picture;
    for (const Vector3d& corner : cornersOf(box)) {
      const Vector3d seen = to_camera * (corner - camera.target);
      picture.extend(Eigen::Vector2d(seen.head<2>() / (distance - seen.z())));
    }
    camera.eye = camera.target + distance * from;
    if (round == 9) break;  // shifted for the last time, and far enough away for it
    const Eigen::Vector2d shift = distance * picture.center();
    camera.target += to_world.linear().leftCols<2>() * shift;
  }
  return camera;
}

Camera lookAt(const Vector3d& eye, const Vector3d& target) { return {.eye = eye, .target = target}; }

Camera alongPath(std::span<const Vector3d> path, double t) {
  if (path.empty()) throw std::invalid_argument("a path without a point cannot be driven along");
  constexpr double kBehind = 12, kAbove = 6, kAhead = 14;  // [m]: a truck's view of what is before the car
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  const double driven = std::clamp(t, 0., 1.) * length;
  const Vector3d here = placeAt(path, driven);
  // A heading from metres before to metres after: poses jitter, and a picture that jitters with them is no pleasure.
  Vector3d heading = placeAt(path, std::min(driven + 4, length)) - placeAt(path, std::max(driven - 4, 0.));
  heading.z() = 0;
  heading = heading.norm() > kSmallest ? heading.normalized() : Vector3d::UnitX();
  return {.eye = here - kBehind * heading + kAbove * Vector3d::UnitZ(), .target = here + kAhead * heading};
}

Eigen::Isometry3d viewOf(const Camera& camera) {
  const Vector3d back = (camera.eye - camera.target).normalized();
  Vector3d right = camera.up.cross(back);
  if (right.norm() < 1e-9) right = Vector3d::UnitX();  // along the up direction any sideways will do
  right.normalize();
  Eigen::Isometry3d to_world = Eigen::Isometry3d::Identity();
  to_world.linear().col(0) = right;
  to_world.linear().col(1) = back.cross(right);
  to_world.linear().col(2) = back;
  to_world.translation() = camera.eye;
  return to_world.inverse();
}

Projection::Projection(const Camera& camera, int width, int height)
    : camera_(camera), view_(viewOf(camera)), width_(width), height_(height) {}

std::optional<Eigen::Vector2d> Projection::toPixel(const Vector3d& point) const {
  const Vector3d seen = view_ * point;
  double scale = 0.5 * height_;  // pixels a unit of what is seen
  if (camera_.view_height) {
    scale /= 0.5 * *camera_.view_height;
  } else {
    if (seen.z() > -1e-6) return std::nullopt;
    scale /= -seen.z() * std::tan(0.5 * camera_.field_of_view);
  }
  return Eigen::Vector2d(0.5 * width_ + scale * seen.x(), 0.5 * height_ - scale * seen.y());
}

double Projection::pixelsPerMetre() const {
  if (camera_.view_height) return height_ / *camera_.view_height;
  const double distance = std::max((camera_.target - camera_.eye).norm(), kSmallest);
  return height_ / (2 * distance * std::tan(0.5 * camera_.field_of_view));
}

Eigen::Matrix4d Projection::clipMatrix(double near, double far) const {
  const double aspect = width_ / height_;
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  if (camera_.view_height) {
    clip(1, 1) = 2 / *camera_.view_height;
    clip(2, 2) = -2 / (far - near);
    clip(2, 3) = -(far + near) / (far - near);
    clip(3, 3) = 1;
  } else {
    clip(1, 1) = 1 / std::tan(0.5 * camera_.field_of_view);
    clip(2, 2) = -(far + near) / (far - near);
    clip(2, 3) = -2 * far * near / (far - near);
    clip(3, 2) = -1;
  }
  clip(0, 0) = clip(1, 1) / aspect;
  return clip;
}

}  // namespace rhmap::render
