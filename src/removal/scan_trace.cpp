// SPDX-License-Identifier: BSD-3-Clause
#include "scan_trace.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rhmap {
namespace {

constexpr std::size_t kAhead = 32;  // points that are looked up together

/// The first hit of this scan in a region.
void touch(Region& region, ScanTrace& trace) {
  region.scan = trace.scan;
  region.loose = true;
  forEachBit(region.hit_octants, [&](int o) {
    Octant& octant = region.octants[static_cast<std::size_t>(o)];
    octant.hit = octant.fresh = octant.appeared = 0;
  });
  region.hit_octants = 0;
  trace.regions.push_back(&region);
}

void insertCube(Region& region, std::size_t o, int bit, int z, int firm) {
  Column& column = *region.column;
  Octant& octant = region.octants[o];
  const std::uint64_t mask = maskOf(bit);
  if ((octant.occupied & mask) == 0) {
    region.add(o, mask);
    octant.fresh |= mask;
    const bool empty = column.h_max < column.h_min;
    column.h_min = empty ? z : std::min(column.h_min, z);
    column.h_max = empty ? z : std::max(column.h_max, z);
  }
  CubeCounts& counts = region.counts[o][static_cast<std::size_t>(bit)];
  countUp(counts.hits);
  if (counts.hits >= firm) octant.firm |= mask;
  counts.misses = 0;
  octant.doubted &= ~mask;
}

/// A point of the scan at this height, in keys. `index`: the column's place in the trace, below 0 if it has none yet.
void addToColumn(Column& column, int z, std::int32_t& index, ScanTrace& trace) {
  if (index < 0) {
    index = static_cast<std::int32_t>(trace.columns.size());
    trace.columns.push_back({.column = &column});
  }
  ScanColumn& in = trace.columns[static_cast<std::size_t>(index)];
  in.z_min = std::min(in.z_min, z);
  in.z_max = std::max(in.z_max, z);
  ++in.points;
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

  std::array<std::uint64_t, kAhead> names;
  std::array<Region*, kAhead> regions;
  for (std::size_t first = 0; first < points.size(); first += kAhead) {
    const std::size_t last = std::min(first + kAhead, points.size());
    // The map is larger than the caches: ask for all that a few points need before it is read.
    for (std::size_t k = first; k < last; ++k) {
      names[k - first] = map.nameOf(points.cube[k]);
      if (k == first || names[k - first] != names[k - first - 1]) map.prefetch(names[k - first]);
    }
    for (std::size_t k = first; k < last; ++k) {
      Region*& region = regions[k - first];
      if (k > first && names[k - first] == names[k - first - 1]) {
        region = regions[k - first - 1];
        continue;
      }
      region = map.find(names[k - first]);
      if (region == nullptr) region = &map.getOrCreate(points.cube[k]);
      __builtin_prefetch(region);
    }
    for (std::size_t k = first; k < last; ++k) {
      const Region& region = *regions[k - first];
      const std::size_t o = map.octantOf(points.cube[k]);
      __builtin_prefetch(&region.octants[o]);
      __builtin_prefetch(&region.counts[o][static_cast<std::size_t>(bitOf(points.cube[k]))]);
    }
    for (std::size_t k = first; k < last; ++k) {
      const OcTreeKey& cube = points.cube[k];
      Region* region = regions[k - first];
      if (region->scan != scan) touch(*region, trace);
      if (points.range[k] <= reach)
        if (std::int32_t* index = grid.at(region->x, region->y)) addToColumn(*region->column, cube[2], *index, trace);
      const std::size_t o = map.octantOf(cube);
      Octant& octant = region->octants[o];
      const int bit = bitOf(cube);
      if ((octant.hit & maskOf(bit)) != 0) continue;
      octant.hit |= maskOf(bit);
      region->hit_octants |= std::uint64_t{1} << o;
      if (config.insert) insertCube(*region, o, bit, cube[2], config.firm);
    }
  }
  return trace;
}

}  // namespace rhmap
