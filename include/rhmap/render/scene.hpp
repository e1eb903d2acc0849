// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "rhmap/render/face_mesh.hpp"
#include "rhmap/render/image.hpp"

namespace rhmap::render {

/// Points [m] of one size.
struct PointSet {
  std::vector<octomap::point3d> points;
  std::vector<Colour> colours;  ///< one a point, or one for all
  float size = 2;               ///< [pixels]
};

/// A line from point to point [m], e.g. where the sensor was.
struct Trajectory {
  std::vector<Eigen::Vector3d> points;
  Colour colour = kTrajectory;
  float width = 3;  ///< [pixels]
};

/// What there is to see.
struct Scene {
  std::vector<FaceMesh> solids = {};
  std::vector<FaceMesh> glass = {};  ///< translucent (Colour::a), seen in front of the solids and through each other
  std::vector<PointSet> clouds = {};
  std::vector<Trajectory> trajectories = {};
};

/// The box [m] around everything in the scene, free space as well; the unit cube for an empty scene.
Box boundsOf(const Scene& scene);

/// How a scene is drawn.
struct PictureConfig {
  int width = 1600;       ///< [pixels]
  int height = 1000;      ///< [pixels]
  int supersampling = 2;  ///< each pixel is the mean of this many squared
  Colour background{250, 250, 252};
};

/// The most pixels that a picture may have along each of its sides: 4K.
inline constexpr int kMaxPictureSide = 4096;

/// A picture of the scene, lit from above; the same for the same input. Needs neither display nor GPU. Throws
/// std::invalid_argument that names the wrong field, std::runtime_error if OSMesa refuses.
Image render(const Scene& scene, const Camera& camera, const PictureConfig& config = {});

}  // namespace rhmap::render
