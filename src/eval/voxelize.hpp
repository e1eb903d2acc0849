// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <array>
#include <cstdint>
#include <vector>

#include "cell_map.hpp"

namespace rhmap::eval {

struct LabelledCloud {
  std::vector<octomap::point3d> points;
  std::vector<std::uint32_t> labels;

  void append(const LabelledCloud& other);
};

/// The mean of the points in each voxel, while they come in; memory goes with the voxels.
class Centroids {
 public:
  explicit Centroids(double voxel) : grid_(voxel) {}

  void add(const octomap::point3d& point);

  /// In the order in which the voxels were first hit.
  std::vector<octomap::point3d> points() const;

 private:
  CellGrid grid_;
  CellMap voxels_;
  std::vector<std::array<double, 4>> sums_;  // x, y, z, count
};

/// The labels of the nearest of `labelled` to each point; 0 where none is within a voxel's diagonal.
std::vector<std::uint32_t> nearestLabels(const std::vector<octomap::point3d>& points, const LabelledCloud& labelled,
                                         double voxel);

/// ERASOR's voxelize_preserving_labels: centroids, each with the label of the cloud's nearest point, in its voxel or
/// not.
LabelledCloud voxelizePreservingLabels(const LabelledCloud& cloud, double voxel);

}  // namespace rhmap::eval
