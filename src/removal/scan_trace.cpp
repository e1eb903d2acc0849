// SPDX-License-Identifier: BSD-3-Clause
#include "scan_trace.hpp"

#include <algorithm>
#include <cmath>

namespace rhmap {
namespace {

/// The first hit of this scan in a region.
void touch(Region& region, ScanTrace& trace) {
  region.scan = trace.scan;
  region.loose = true;
  region.forEachHitOctant([](std::size_t, Octant& octant) { octant.hit = octant.fresh = octant.appeared = 0; });
  region.hit_octants = 0;
  trace.regions.push_back(&region);
}

void insertCube(Column& column, Octant& octant, int bit, int z, int firm) {
  const std::uint64_t mask = maskOf(bit);
  if ((octant.occupied & mask) == 0) {
    octant.occupied |= mask;
    octant.fresh |= mask;
    const bool empty = column.h_max < column.h_min;
    column.h_min = empty ? z : std::min(column.h_min, z);
    column.h_max = empty ? z : std::max(column.h_max, z);
  }
  const auto i = static_cast<std::size_t>(bit);
  countUp(octant.hits[i]);
  if (octant.hits[i] >= firm) octant.firm |= mask;
  octant.misses[i] = 0;
  octant.doubted &= ~mask;
}

}  // namespace

ColumnGrid::ColumnGrid(const RegionMap& map, const OcTreeKey& sensor, double reach, double resolution)
    : half_(static_cast<int>(std::ceil(reach / (map.size() * resolution))) + 1),
      side_(2 * half_ + 1),
      x0_((sensor[0] >> map.bits()) - half_),
      y0_((sensor[1] >> map.bits()) - half_),
      index_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), -1) {}

ScanTrace traceScan(RegionMap& map, const ScanPoints& points, const OcTreeKey& sensor, std::uint32_t scan,
                    const TraceConfig& config) {
  ScanTrace trace{.scan = scan, .columns = {}, .regions = {}};
  ColumnGrid grid(map, sensor, config.reach, config.resolution);
  const auto reach = static_cast<float>(config.reach);
  const int bits = map.bits();

  Column* column = nullptr;
  Region* region = nullptr;
  std::int32_t* index = nullptr;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const OcTreeKey& cube = points.cube[k];
    const auto x = static_cast<key_type>(cube[0] >> bits), y = static_cast<key_type>(cube[1] >> bits),
               z = static_cast<key_type>(cube[2] >> bits);
    if (column == nullptr || column->x != x || column->y != y) {
      column = &map.getOrCreate(x, y);
      region = nullptr;
      index = grid.at(x, y);
    }
    if (region == nullptr || region->z != z) {
      region = &map.getOrCreate(*column, z);
      if (region->scan != scan) touch(*region, trace);
    }
    if (index != nullptr && points.range[k] <= reach) {
      if (*index < 0) {
        *index = static_cast<std::int32_t>(trace.columns.size());
        trace.columns.push_back({.column = column});
      }
      ScanColumn& in = trace.columns[static_cast<std::size_t>(*index)];
      in.z_min = std::min(in.z_min, int{cube[2]});
      in.z_max = std::max(in.z_max, int{cube[2]});
      ++in.points;
    }
    const std::size_t o = map.octantOf(cube);
    Octant& octant = region->octants[o];
    const int bit = bitOf(cube);
    if ((octant.hit & maskOf(bit)) != 0) continue;
    octant.hit |= maskOf(bit);
    region->hit_octants |= std::uint64_t{1} << o;
    if (config.insert) insertCube(*column, octant, bit, cube[2], config.firm);
  }
  return trace;
}

}  // namespace rhmap
