// SPDX-License-Identifier: BSD-3-Clause
#include "scan_trace.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rhmap {
namespace {

constexpr std::size_t kAhead = 64;  // points that are looked up together

/// The first hit of this scan in a region.
void touch(Region& region, ScanTrace& trace) {
  region.scan = trace.scan;
  forEachBit(region.hit_octants, [&](int o) {
    Octant& octant = region.octants[static_cast<std::size_t>(o)];
    octant.hit = octant.fresh = octant.appeared = 0;
  });
  region.hit_octants = 0;
  trace.regions.push_back(&region);
}

/// The hit cubes of an octant: in the map from now on, and with nothing that speaks against them.
void insert(Region& region, std::size_t o, int firm) {
  Octant& octant = region.octants[o];
  OctantCounts& counts = region.counts[o];
  octant.fresh = octant.hit & ~octant.occupied;
  octant.doubted &= ~octant.hit;
  forEachBit(octant.hit, [&](int bit) {
    CubeCounts& of = counts[static_cast<std::size_t>(bit)];
    countUp(of.hits);
    of.misses = 0;
    octant.firm |= std::uint64_t{of.hits >= firm} << bit;
  });
  region.add(o, octant.fresh);
  region.loose = region.loose || octant.fresh != 0;
}

/// H{max,min} with what a scan has added to a region.
void raiseHeights(const RegionMap& map, const Region& region) {
  Column& column = *region.column;
  forEachBit(region.hit_octants, [&](int o) {
    const auto number = static_cast<std::size_t>(o);
    const std::uint64_t fresh = region.octants[number].fresh;
    if (fresh == 0) return;
    const int corner = map.cornerOf(region, number)[2];
    int low = 0, high = 3;
    while ((fresh & layerOf(low)) == 0) ++low;
    while ((fresh & layerOf(high)) == 0) --high;
    const bool empty = column.h_max < column.h_min;
    column.h_min = empty ? corner + low : std::min(column.h_min, corner + low);
    column.h_max = empty ? corner + high : std::max(column.h_max, corner + high);
  });
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
    }
    for (std::size_t k = first; k < last; ++k) {
      const OcTreeKey& cube = points.cube[k];
      Region* region = regions[k - first];
      if (region->scan != scan) touch(*region, trace);
      if (points.range[k] <= reach)
        if (std::int32_t* index = grid.at(region->x, region->y)) addToColumn(*region->column, cube[2], *index, trace);
      const std::size_t o = map.octantOf(cube);
      region->octants[o].hit |= maskOf(bitOf(cube));
      region->hit_octants |= std::uint64_t{1} << o;
    }
  }
  if (config.insert) {
    trace.forEachRegion<true>([&](Region& region) {
      forEachBit(region.hit_octants, [&](int o) { insert(region, static_cast<std::size_t>(o), config.firm); });
      raiseHeights(map, region);
    });
  }
  return trace;
}

}  // namespace rhmap
