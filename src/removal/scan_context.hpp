// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "range_image.hpp"
#include "scan_trace.hpp"
#include "visibility.hpp"

namespace rhmap {

/// ^{2d}S^W at one O_r, Eq. (7).
struct Context2d {
  key_type x, y;      ///< O_r >> bits
  int z_min, z_max;   ///< Z_min and Z_max as keys
  int points;         ///< of the scan in it
  bool max_ring;      ///< a point of P_max is in it
  bool bulge_dented;  ///< a point of P_sup or P_inf is in it
};

/// ^{3d}S^W at one I_r, Eq. (11).
struct Context3d {
  key_type x, y, z;  ///< I_r >> bits
  int z_min, z_max;  ///< Z_min and Z_max of the points of P_sup and P_inf, as keys
  int sup, inf;      ///< the least upper and the greatest lower bound, as keys
};

/// A scan as the map is compared with it, now or later.
struct ScanContext {
  std::vector<Context2d> columns;
  std::vector<Context3d> regions;
  SensorView view;
  std::shared_ptr<const Visibility> visibility;  ///< null: not wanted
};

/// Eq. (8), heights in cubes with both ends counted. `max_ring`: its second case.
double ratio1(const Context2d& scan, int map_min, int map_max, bool max_ring);

/// Eq. (13), first case.
double ratio2(const Context3d& scan, int map_min, int map_max);

/// P_max: marks the columns of the trace that hold a point of the image's highest ring.
void findMaxRing(const RangeImage& image, const ScanPoints& points, const RegionMap& map, ColumnGrid& grid,
                 ScanTrace& trace);

/// P_sup and P_inf, Eqs. (9) and (10): marks their columns and gives their contexts, ordered by position.
std::vector<Context3d> findBulgeDented(const RangeImage& image, const ScanPoints& points, const ContextConfig& config,
                                       const RegionMap& map, ColumnGrid& grid, ScanTrace& trace);

/// The 2D contexts of a trace.
std::vector<Context2d> contextsOf(const ScanTrace& trace);

}  // namespace rhmap
