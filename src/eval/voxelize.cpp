// SPDX-License-Identifier: BSD-3-Clause
#include "voxelize.hpp"

#include <cmath>

#include "point_grid.hpp"

namespace rhmap::eval {

void LabelledCloud::append(const LabelledCloud& other) {
  points.insert(points.end(), other.points.begin(), other.points.end());
  labels.insert(labels.end(), other.labels.begin(), other.labels.end());
}

void Centroids::add(const octomap::point3d& point) {
  const std::uint32_t id = voxels_.findOrAdd(grid_.cellOf(point));
  if (id == sums_.size()) sums_.push_back({});
  auto& [x, y, z, count] = sums_[id];
  x += point.x();
  y += point.y();
  z += point.z();
  ++count;
}

std::vector<octomap::point3d> Centroids::points() const {
  std::vector<octomap::point3d> points;
  points.reserve(sums_.size());
  for (const auto& [x, y, z, count] : sums_)
    points.emplace_back(static_cast<float>(x / count), static_cast<float>(y / count), static_cast<float>(z / count));
  return points;
}

std::vector<std::uint32_t> nearestLabels(const std::vector<octomap::point3d>& points, const LabelledCloud& labelled,
                                         double voxel) {
  const PointGrid grid(labelled.points, voxel);
  std::vector<std::uint32_t> labels;
  labels.reserve(points.size());
  for (const octomap::point3d& point : points) {
    const auto nearest = grid.nearest(point, std::sqrt(3) * voxel);
    labels.push_back(nearest ? labelled.labels[nearest->index] : 0);
  }
  return labels;
}

LabelledCloud voxelizePreservingLabels(const LabelledCloud& cloud, double voxel) {
  Centroids centroids(voxel);
  for (const octomap::point3d& point : cloud.points) centroids.add(point);
  LabelledCloud result{.points = centroids.points(), .labels = {}};
  result.labels = nearestLabels(result.points, cloud, voxel);
  return result;
}

}  // namespace rhmap::eval
