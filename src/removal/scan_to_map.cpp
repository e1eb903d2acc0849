// SPDX-License-Identifier: BSD-3-Clause
#include "scan_to_map.hpp"

#include <algorithm>
#include <cmath>

namespace rhmap {

double ratio1(int scan_min, int scan_max, int map_min, int map_max) {
  return double(scan_max - scan_min + 1) / double(map_max - map_min + 1);
}

void removeByScan(RegionMap& map, const ScanContext& scan, const RemovalConfig& config, double resolution,
                  std::uint32_t protect_scan, int revert_hits, RemovalResult& result) {
  const ContextConfig& limits = config.context;
  const double min_height = limits.min_height / resolution;
  for (const ColumnContext& context : scan.columns) {
    if (context.points < limits.min_points) continue;
    Column* column = map.find(context.x, context.y);
    if (column == nullptr) continue;
    if (config.shrink_heights) map.refreshHeights(*column);
    if (column->h_max < column->h_min) continue;
    const int h_min = std::min(column->h_min, context.z_min);
    int h_max = std::max(column->h_max, context.z_max);
    // TODO fov
    if (context.max_ring) h_max = context.z_max;
    if (h_max - h_min + 1 < min_height) continue;
    if (ratio1(context.z_min, context.z_max, h_min, h_max) >= limits.delta_1) continue;
    for (const auto& region : column->regions) {
      if (((region->z + 1) << map.bits()) <= context.z_min - 1) continue;
      for (int o = 0; o < map.octants(); ++o) {
        Octant& octant = region->octants[static_cast<std::size_t>(o)];
        if (octant.occupied == 0) continue;
        std::uint64_t candidates = octant.occupied & ~octant.ground;
        if (config.protect_hits && region->scan == protect_scan) candidates &= ~octant.hit;
        if (candidates == 0) continue;
        const OcTreeKey corner = map.cornerOf(*region, o);
        std::uint64_t gone = 0;
        forEachBit(candidates, [&](int bit) {
          if (revert_hits > 0 && octant.hits[static_cast<std::size_t>(bit)] >= revert_hits) return;
          if (config.visibility.enabled && !scan.visibility.seesThrough(scan.view(cubeOf(corner, bit)))) return;
          gone |= std::uint64_t{1} << bit;
        });
        result.is_protected += static_cast<std::size_t>(std::popcount(octant.occupied & ~gone));
        if (gone == 0) continue;
        octant.occupied &= ~gone;
        forEachBit(gone, [&](int bit) { octant.hits[static_cast<std::size_t>(bit)] = 0; });
        column->stale = true;
        result.removed.push_back({corner, gone, config.visibility.enabled});
      }
    }
  }
}

}  // namespace rhmap
