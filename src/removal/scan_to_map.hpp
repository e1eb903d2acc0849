// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "region_map.hpp"
#include "rhmap/removal/removal_config.hpp"
#include "scan_insertion.hpp"
#include "visibility.hpp"

namespace rhmap {
extern std::vector<std::array<int,8>>* g_dbg; extern int g_reason; extern int g_scan;

/// ^{2d}S^W at one O_r, on its own.
struct ColumnContext {
  key_type x, y;    ///< O_r >> bits
  int z_min, z_max; ///< keys
  int points;
  bool max_ring;
};

/// A scan as the map is compared with it.
struct ScanContext {
  std::vector<ColumnContext> columns;
  SensorView view;
  Visibility visibility;
};

/// Cubes that left the map.
struct RemovedOctant {
  OcTreeKey corner;
  std::uint64_t cubes;
  bool seen_through;
};

struct RemovalResult {
  std::vector<RemovedOctant> removed;
  std::size_t is_protected = 0;  ///< cubes of candidates that stay
};

/// S2M-R (Sec. III-C.2): removes from the map what the scan shows to have gone. `scan`: the number of the scan whose hits
/// are not to be touched; 0: none.
void removeByScan(RegionMap& map, const ScanContext& scan, const RemovalConfig& config, double resolution,
                  std::uint32_t protect_scan, int revert_hits, bool late, const class GroundEstimation& ground, RemovalResult& result);

/// Eq. (8), with heights counted in cubes, both ends included.
double ratio1(int scan_min, int scan_max, int map_min, int map_max);

}  // namespace rhmap
