// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/Pointcloud.h>
#include <octomap/octomap_types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rhmap/core/cell_word.hpp"
#include "rhmap/octree/key_space.hpp"

namespace rhmap {

/// The points P^B of a scan that count, in the sensor's frame, with the cubes that they fall in.
struct ScanPoints {
  std::vector<float> x, y, z;       ///< sensor frame [m]
  std::vector<float> range;         ///< [m]
  std::vector<std::uint64_t> cell;  ///< the cubes, as cell_word names them
  std::size_t given = 0;
  std::size_t dropped = 0;  ///< not finite, outside of the tree, too near or too far

  std::size_t size() const { return cell.size(); }
  OcTreeKey cubeAt(std::size_t k) const { return cell_word::toKey(cell[k]); }
};

/// Takes a scan to the map: P^W = T P^B, and I = floor(P^W / s_c), Eq. (1), with octomap::pose6d's own arithmetic, so
/// that a point finds its cube again. `max_range` below 0: no limit.
void locatePoints(const KeySpace& keys, const octomap::Pointcloud& points, const octomap::pose6d& pose,
                  double min_range, double max_range, ScanPoints& scan);

}  // namespace rhmap
