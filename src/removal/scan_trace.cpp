// SPDX-License-Identifier: BSD-3-Clause
#include "scan_trace.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rhmap {
namespace {

constexpr std::size_t kAhead = 32;  // octants that are looked up together

/// Points that follow each other in the scan and fall in one octant.
struct Run {
  OcTreeKey cube;             // one of them
  std::uint64_t cubes = 0;    // of the octant
  std::uint64_t reached = 0;  // of these, with points that contexts reach
  int points = 0;             // that contexts reach
  std::uint64_t name = 0;     // of the region
  Region* region = nullptr;
};

/// The first hit of this scan in a region.
void touch(Region& region, ScanTrace& trace) {
  region.scan = trace.scan;
  forEachBit(region.hit_octants, [&](int o) {
    Octant& octant = region.octant(static_cast<std::size_t>(o));
    octant.hit = octant.fresh = octant.appeared = 0;
  });
  region.hit_octants = 0;
  trace.regions.push_back(&region);
}

/// The hit cubes of an octant: in the map from now on, and with nothing that speaks against them.
void insert(Region& region, std::size_t o, int firm) {
  Octant& octant = region.octant(o);
  OctantCounts& counts = countsOf(octant);
  octant.fresh = octant.hit & ~octant.occupied;
  octant.doubted &= ~octant.hit;
  forEachBit(octant.hit, [&](int bit) {
    CubeCounts& of = counts[static_cast<std::size_t>(bit)];
    countUp(of.hits);
    of.misses = 0;
    octant.firm |= std::uint64_t{of.hits >= firm} << bit;
  });
  region.add(o, octant.fresh);
}

/// H{max,min} with what a scan has added to a region.
void raiseHeights(const RegionMap& map, const Region& region) {
  int low = 1 << 16, high = -1;
  forEachBit(region.hit_octants, [&](int o) {
    const auto number = static_cast<std::size_t>(o);
    const std::uint64_t fresh = region.octant(number).fresh;
    if (fresh == 0) return;
    const int corner = map.cornerOf(region, number)[2];
    const auto [bottom, top] = layersOf(fresh);
    low = std::min(low, corner + bottom), high = std::max(high, corner + top);
  });
  if (low <= high) region.column->raise(low, high);
}

/// The next run of a scan, from point `k` on, which moves on.
Run nextRun(const RegionMap& map, const ScanPoints& points, float reach, std::size_t& k) {
  const std::uint64_t first = points.cell[k];
  Run run{.cube = cell_word::toKey(first)};
  do {
    const std::uint64_t cube = maskOf(static_cast<int>(points.cell[k] & 63));
    const bool is_reached = points.range[k] <= reach;
    run.cubes |= cube;
    run.reached |= is_reached ? cube : 0;
    run.points += is_reached;
  } while (++k < points.size() && (points.cell[k] ^ first) >> 6 == 0);
  run.name = map.nameOf(run.cube);
  return run;
}

/// `index`: the column's place in the trace, below 0 if it has none yet.
void addToColumn(Column& column, const Run& run, std::int32_t& index, ScanTrace& trace) {
  if (index < 0) {
    index = static_cast<std::int32_t>(trace.columns.size());
    trace.columns.push_back({.column = &column});
  }
  ScanColumn& in = trace.columns[static_cast<std::size_t>(index)];
  const int corner = run.cube[2] & ~3;
  const auto [bottom, top] = layersOf(run.reached);
  in.z_min = std::min(in.z_min, corner + bottom);
  in.z_max = std::max(in.z_max, corner + top);
  in.points += run.points;
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

  std::array<Run, kAhead> runs;
  for (std::size_t k = 0; k < points.size();) {
    // The map is larger than the caches: ask for all that a few octants need before it is read.
    std::size_t n = 0;
    for (; n < kAhead && k < points.size(); ++n) {
      runs[n] = nextRun(map, points, reach, k);
      if (n == 0 || runs[n].name != runs[n - 1].name) map.prefetch(runs[n].name);
    }
    for (std::size_t i = 0; i < n; ++i) {
      Region*& region = runs[i].region;
      if (i > 0 && runs[i].name == runs[i - 1].name) {
        region = runs[i - 1].region;
        continue;
      }
      region = map.find(runs[i].name);
      if (region == nullptr) region = &map.getOrCreate(runs[i].cube);
      Region::prefetch(region);
    }
    for (std::size_t i = 0; i < n; ++i) __builtin_prefetch(&runs[i].region->octant(map.octantOf(runs[i].cube)));
    for (std::size_t i = 0; i < n; ++i) {
      const Run& run = runs[i];
      Region& region = *run.region;
      if (region.scan != scan) touch(region, trace);
      if (run.points > 0)
        if (std::int32_t* index = grid.at(region.x, region.y)) addToColumn(*region.column, run, *index, trace);
      const std::size_t o = map.octantOf(run.cube);
      map.getOrCreate(region, o).hit |= run.cubes;
      region.hit_octants |= std::uint64_t{1} << o;
    }
  }
  if (config.insert) {
    const auto askFor = [](const Region& region, std::size_t o) __attribute__((always_inline)) {
      __builtin_prefetch(region.column);
      const OctantCounts& counts = countsOf(region.octant(o));
      __builtin_prefetch(&counts.front());
      __builtin_prefetch(&counts.back());
    };
    trace.forEachRegion(askFor, [&](Region& region) {
      forEachBit(region.hit_octants, [&](int o) { insert(region, static_cast<std::size_t>(o), config.firm); });
      raiseHeights(map, region);
    });
  }
  return trace;
}

}  // namespace rhmap
