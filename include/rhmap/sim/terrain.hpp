// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "rhmap/sim/labels.hpp"

namespace rhmap::sim {

/// A rectangle of the ground with a class of its own, seen from above [m, rad].
struct GroundPatch {
  Eigen::Vector2d centre;
  Eigen::Vector2d half;
  double yaw = 0;
  Class cls = kRoad;
};

/// Heights [m] at the corners of square cells; `heights` has x running fastest. The border is at height 0, where the
/// flat world around it is.
struct HeightGrid {
  Eigen::Vector2d corner{0, 0};  ///< Where the first height stands.
  double cell = 1;
  std::size_t columns = 0;  ///< Heights along x.
  std::size_t rows = 0;     ///< Heights along y.
  std::vector<double> heights;
};

/// The ground: the plane z = 0, in part replaced by two triangles for each cell of a height grid.
class Terrain {
 public:
  explicit Terrain(Class cls = kTerrain) : cls_(cls) {}

  /// Throws std::invalid_argument unless the grid has 2 x 2 heights or more and is 0 along its border.
  void setHeights(HeightGrid grid);

  /// Later patches lie over earlier ones.
  void addPatch(const GroundPatch& patch) { patches_.push_back(patch); }

  /// Height [m] and unit normal above a point of the plane.
  double height(double x, double y) const;
  Eigen::Vector3d normal(double x, double y) const;

  Class classAt(double x, double y) const;

  /// Distance [m] along a ray to the ground, kNoHit if it is not met within max_range; `direction` has length 1.
  double hitDistance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double max_range) const;

 private:
  bool inGrid(double x, double y) const;
  double hitGrid(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double max_range) const;

  Class cls_;
  std::vector<GroundPatch> patches_;
  HeightGrid grid_;
};

}  // namespace rhmap::sim
