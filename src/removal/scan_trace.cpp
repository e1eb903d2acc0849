// SPDX-License-Identifier: BSD-3-Clause
#include "scan_trace.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rhmap {
namespace {

constexpr std::size_t kAhead = 32;  // octants that are looked up together

/// Notes what the scan has hit of an octant.
void mark(const TracedOctant& at, const HitOctant& hit, ScanTrace& trace) {
  Region& region = *at.region;
  if (region.scan != trace.scan) {
    region.scan = trace.scan;
    region.hit_octants = region.fresh_octants = 0;
    trace.regions.push_back(&region);
  }
  region.hit_octants |= std::uint64_t{1} << at.number;
  at.octant->hit = hit.cubes;
  at.octant->fresh = at.octant->appeared = 0;
  trace.octants.push_back(at);
}

/// The hit cubes of an octant: in the map from now on, and with nothing that speaks against them.
void insert(const TracedOctant& at, int firm) {
  Octant& octant = *at.octant;
  OctantHistory& history = historyOf(octant);
  octant.fresh = octant.hit & ~octant.occupied;
  forEachBit(octant.doubted & octant.hit, [&](int bit) { history.misses[static_cast<std::size_t>(bit)] = 0; });
  octant.doubted &= ~octant.hit;
  octant.firm |= countUp(history.hits, octant.hit, firm);
  if (octant.fresh == 0) return;
  at.region->fresh_octants |= std::uint64_t{1} << at.number;
  at.region->add(at.number, octant.fresh);
  const auto [bottom, top] = layersOf(octant.fresh);
  at.region->column->raise(at.corner[2] + bottom, at.corner[2] + top);
}

/// `index`: the column's place in the trace, below 0 if it has none yet.
void addToColumn(const TracedOctant& at, const HitOctant& hit, std::int32_t& index, ScanTrace& trace) {
  if (index < 0) {
    index = static_cast<std::int32_t>(trace.columns.size());
    trace.columns.push_back({.column = at.region->column});
  }
  ScanColumn& in = trace.columns[static_cast<std::size_t>(index)];
  const auto [bottom, top] = layersOf(hit.reached);
  in.z_min = std::min(in.z_min, at.corner[2] + bottom);
  in.z_max = std::max(in.z_max, at.corner[2] + top);
  in.points += hit.points;
}

}  // namespace

ColumnGrid::ColumnGrid(const RegionMap& map, const OcTreeKey& sensor, double reach, double resolution)
    : half_(static_cast<int>(std::ceil(reach / (map.size() * resolution))) + 1),
      side_(2 * half_ + 1),
      x0_((sensor[0] >> map.bits()) - half_),
      y0_((sensor[1] >> map.bits()) - half_),
      index_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), -1) {}

void traceScan(RegionMap& map, const ScanOctants& octants, const OcTreeKey& sensor, std::uint32_t scan,
               const TraceConfig& config, ScanTrace& trace) {
  trace.scan = scan;
  trace.columns.clear();
  trace.regions.clear();
  trace.octants.clear();
  ColumnGrid grid(map, sensor, config.reach, config.resolution);
  const std::vector<HitOctant>& hits = octants.list();
  std::array<TracedOctant, kAhead> places;
  std::array<std::uint64_t, kAhead> names;  // of their regions
  for (std::size_t first = 0; first < hits.size(); first += kAhead) {
    // The map is larger than the caches: ask for all that a few octants need before it is read.
    const std::size_t n = std::min(kAhead, hits.size() - first);
    for (std::size_t i = 0; i < n; ++i) {
      TracedOctant& at = places[i];
      at.corner = hits[first + i].corner();
      at.number = static_cast<std::uint16_t>(map.octantOf(at.corner));
      names[i] = map.nameOf(at.corner);
      map.prefetch(names[i]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      TracedOctant& at = places[i];
      at.region = i > 0 && names[i] == names[i - 1] ? places[i - 1].region : map.find(names[i]);
      if (at.region == nullptr) at.region = &map.getOrCreate(at.corner);
      Region::prefetch(at.region);
    }
    for (std::size_t i = 0; i < n; ++i) {
      TracedOctant& at = places[i];
      at.octant = &map.getOrCreate(*at.region, at.number);
      __builtin_prefetch(at.octant);
      __builtin_prefetch(at.region->column);
      __builtin_prefetch(&historyOf(*at.octant).hits);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const TracedOctant& at = places[i];
      const HitOctant& hit = hits[first + i];
      mark(at, hit, trace);
      if (config.insert) insert(at, config.firm);
      if (hit.points > 0)
        if (std::int32_t* index = grid.at(at.region->x, at.region->y)) addToColumn(at, hit, *index, trace);
    }
  }
}

}  // namespace rhmap
