// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "region_map.hpp"
#include "scan_points.hpp"

namespace rhmap {

/// ^{2d}S^W at one O_r (Eq. 7): what the scan has in a column of regions, as far as contexts reach.
struct ScanColumn {
  Column* column = nullptr;
  int z_max = -1, z_min = 1 << 16;  ///< keys of the highest and lowest cube
  int points = 0;
  bool max_ring = false;  ///< a point of the scan's highest ring is in it
};

/// What a scan has touched.
struct ScanTrace {
  std::uint32_t scan = 0;              ///< its number, from 1
  std::vector<ScanColumn> columns;     ///< within reach of contexts
  std::vector<Region*> regions;        ///< all with a hit
};

/// Marks the cubes of a scan in the regions: Octant::hit and, with `insert`, Octant::occupied, the counts and H. Points
/// within `reach` [m] make the 2D scan context.
ScanTrace insertScan(RegionMap& map, const ScanPoints& points, const OcTreeKey& sensor, double reach, double resolution,
                     std::uint32_t scan, bool insert, int firm);

}  // namespace rhmap
