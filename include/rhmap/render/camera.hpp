// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

namespace rhmap::render {

/// A box in the world frame [m].
using Box = Eigen::AlignedBox3d;

/// Where a picture is taken from, and how. World frame, z up, metres.
struct Camera {
  Eigen::Vector3d eye{-1, -1, 1};
  Eigen::Vector3d target{0, 0, 0};
  Eigen::Vector3d up{0, 0, 1};
  double field_of_view = 0.8;              ///< vertical, of a perspective picture [rad]
  std::optional<double> view_height = {};  ///< of an orthographic picture: what its height shows [m]; none: perspective
};

/// From straight above, orthographic, x to the right; the whole box is in the picture. `aspect` is width over height.
Camera topView(const Box& box, double aspect);

/// Orthographic, all three axes of the world at the same scale, x and y away from the viewer.
Camera isometricView(const Box& box, double aspect);

/// Perspective, from this azimuth (the side of the box that the eye is on, counted from x towards y [rad]) and
/// elevation above the ground [rad]; as near as the whole box allows.
Camera orbitView(const Box& box, double azimuth, double elevation, double aspect);

/// Perspective from `eye` to `target`.
Camera lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

/// Drives along: from behind and above the place that the fraction `t` (0 ... 1) of the path's length has been driven
/// to, in the direction of travel. A path that never moves looks along x. The path must have a point;
/// std::invalid_argument otherwise.
Camera alongPath(std::span<const Eigen::Vector3d> path, double t);

/// World to camera: x right, y up, z towards the viewer.
Eigen::Isometry3d viewOf(const Camera& camera);

/// How a camera maps the world into a picture of this size.
class Projection {
 public:
  Projection(const Camera& camera, int width, int height);

  /// Pixels from the left and from the top; nothing for what is behind the eye.
  std::optional<Eigen::Vector2d> toPixel(const Eigen::Vector3d& point) const;

  /// Pixels that a metre takes at the target, across the line of sight.
  double pixelsPerMetre() const;

  /// OpenGL's matrix, camera frame to clip coordinates, for what lies between these distances [m].
  Eigen::Matrix4d clipMatrix(double near, double far) const;

 private:
  Camera camera_;
  Eigen::Isometry3d view_;
  double width_;
  double height_;
};

}  // namespace rhmap::render
