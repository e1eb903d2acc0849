// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rhmap/octree/key_space.hpp"
#include "rhmap/octree/ray_batch.hpp"

namespace rhmap {

/// What is the same for all rays of a scan.
struct RayOrigin {
  RayOrigin(const KeySpace& keys, const octomap::point3d& origin, double max_range);

  std::array<float, 3> point;
  double max_range;  ///< [m]; negative: no limit
  double resolution;
  double inverse_resolution;
  bool inside;         ///< of the tree
  std::uint64_t cell;  ///< a cell word
  /// Along each axis, from the origin to the cell's border on the way up and on the way down [m].
  std::array<double, 3> up, down;
};

/// The cells that a scan hits, as cell words.
struct HitCells {
  std::array<std::uint64_t, RayBatch::kCapacity + RayBatch::kPad> cell;
  std::size_t size = 0;
};

/// What became of some points.
struct RayCounts {
  std::size_t not_finite = 0, outside = 0;
};

/// Sets up a ray for each point, as OctoMap's computeUpdate and computeRayKeys do: cut at the range, with a hit where
/// it is not. Adds rays and hits where there are any; there must be room for as many rays as there are points. In
/// vectors, with the same bits as startSegment().
RayCounts startRays(const RayOrigin& origin, std::span<const octomap::point3d> points, RayBatch& rays, HitCells& hits);

}  // namespace rhmap
