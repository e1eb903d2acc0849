// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/Pointcloud.h>

#include <cstddef>

#include "rhmap/octree/key_space.hpp"
#include "rhmap/octree/scan_masks.hpp"

namespace rhmap {

/// OctoMap's bounding box for insertions: points compared in metres, cells by their keys, both inclusive.
struct KeyBox {
  point3d min, max;
  OcTreeKey min_key, max_key;

  bool contains(const point3d& p) const {
    return p.x() >= min.x() && p.y() >= min.y() && p.z() >= min.z() && p.x() <= max.x() && p.y() <= max.y() &&
           p.z() <= max.z();
  }
  bool contains(const OcTreeKey& k) const {
    return k[0] >= min_key[0] && k[1] >= min_key[1] && k[2] >= min_key[2] && k[0] <= max_key[0] && k[1] <= max_key[1] &&
           k[2] <= max_key[2];
  }
};

/// How a scan is turned into cells.
struct ScanMarkingConfig {
  double max_range = -1;        ///< [m]; longer rays free the space up to here and hit nothing. Negative: no limit
  const KeyBox* box = nullptr;  ///< where set: hits inside only, free cells from the origin on up to the first outside
  int num_threads = 1;
};

/// What became of the points of a scan.
struct ScanCounts {
  std::size_t points = 0;
  std::size_t not_finite = 0;  ///< NaN or infinite: skipped
  std::size_t outside =
      0;  ///< the ray starts or ends outside of the tree: frees nothing, and hits only where the end is inside
};

/// OctoMap's computeUpdate. Points and origin in the map's frame [m]. The answer does not depend on the number of
/// threads.
ScanMasks markScan(const KeySpace& keys, const octomap::Pointcloud& scan, const point3d& origin,
                   const ScanMarkingConfig& config, ScanCounts& counts);

/// The cells of a scan as OctoMap collects them: in its sets, filled in its order, which is what decides about the
/// order in which it updates the cells.
struct ScanCells {
  using Keys = octomap::unordered_ns::unordered_set<OcTreeKey, OcTreeKey::KeyHash>;  // std or, mostly, std::tr1
  Keys free, occupied;                                                               ///< no cell is in both
};

/// Occupied wins: takes the cells that are in both sets out of the first.
template <class KEYS>
void removeOccupied(KEYS& free, const KEYS& occupied) {
  for (auto it = free.begin(); it != free.end();) {
    if (occupied.count(*it) != 0) {
      it = free.erase(it);
    } else {
      ++it;
    }
  }
}

/// The cells that markScan() marks, found one ray after the other: for trees that have to be asked about every cell.
ScanCells collectScan(const KeySpace& keys, const octomap::Pointcloud& scan, const point3d& origin,
                      const ScanMarkingConfig& config, ScanCounts& counts);

/// One point for each cell that has a point: the cell's centre, in the order of first appearance. Points outside of the
/// tree wrap around, as in OctoMap; those that are not finite are skipped and counted.
octomap::Pointcloud discretize(const KeySpace& keys, const octomap::Pointcloud& scan, ScanCounts& counts);

}  // namespace rhmap
