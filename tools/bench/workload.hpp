// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/Pointcloud.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "rhmap/core/key.hpp"

namespace rhmap::bench {

class Library;

/// A scan in the world frame [m].
struct WorldScan {
  octomap::Pointcloud points;
  octomap::point3d origin;
};

/// The first scans of a recording.
std::vector<WorldScan> loadScans(const std::filesystem::path& sequence, std::size_t count);

/// One cell to change.
struct CellUpdate {
  octomap::OcTreeKey key;
  bool occupied;
};

/// A ray to cast.
struct Cast {
  octomap::point3d origin;
  octomap::point3d direction;
};

/// What the map benchmarks ask; drawn once, from fixed seeds, for both libraries.
struct MapWorkload {
  std::vector<octomap::OcTreeKey> leaves;     ///< random leaves
  std::vector<octomap::OcTreeKey> ray_cells;  ///< the cells of random rays of the scans, ray by ray
  std::vector<octomap::point3d> points;       ///< uniform in the bounds of the leaves [m]
  std::vector<Cast> casts;                    ///< random directions from where the sensor stood
  octomap::OcTreeKey box_min, box_max;        ///< 20 x 20 x 6 m around the first of these places

  // One list a round, so that no round finds what the one before it has changed.
  std::vector<std::vector<CellUpdate>> known_cells;      ///< random leaves, hits and misses
  std::vector<std::vector<CellUpdate>> scattered_cells;  ///< unknown cells, uniform in the bounds
  std::vector<std::vector<CellUpdate>> box_cells;        ///< a solid box of free cells above the map, row by row
};

MapWorkload drawWorkload(const Library& library, double resolution, std::span<const WorldScan> scans,
                         std::size_t rounds);

}  // namespace rhmap::bench
