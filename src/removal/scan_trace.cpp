// SPDX-License-Identifier: BSD-3-Clause
#include "scan_trace.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rhmap {
namespace {

constexpr std::size_t kAhead = 32;  // octants that are looked up together

/// What the map has for an octant of the scan.
struct Place {
  std::uint64_t name = 0;  // of the region
  Region* region = nullptr;
  std::size_t o = 0;
  Octant* octant = nullptr;
};

/// Notes what the scan has hit of an octant.
void mark(const Place& place, const HitOctant& hit, ScanTrace& trace) {
  Region& region = *place.region;
  if (region.scan != trace.scan) {
    region.scan = trace.scan;
    region.hit_octants = region.fresh_octants = 0;
    trace.regions.push_back(&region);
  }
  region.hit_octants |= std::uint64_t{1} << place.o;
  place.octant->hit = hit.cubes;
  place.octant->fresh = place.octant->appeared = 0;
}

/// The hit cubes of an octant: in the map from now on, and with nothing that speaks against them.
void insert(const Place& place, const HitOctant& hit, int firm) {
  Octant& octant = *place.octant;
  OctantCounts& counts = countsOf(octant);
  octant.fresh = octant.hit & ~octant.occupied;
  octant.doubted &= ~octant.hit;
  forEachBit(octant.hit, [&](int bit) {
    CubeCounts& of = counts[static_cast<std::size_t>(bit)];
    countUp(of.hits);
    of.misses = 0;
    octant.firm |= std::uint64_t{of.hits >= firm} << bit;
  });
  if (octant.fresh == 0) return;
  place.region->fresh_octants |= std::uint64_t{1} << place.o;
  place.region->add(place.o, octant.fresh);
  const int corner = hit.corner()[2];
  const auto [bottom, top] = layersOf(octant.fresh);
  place.region->column->raise(corner + bottom, corner + top);
}

/// `index`: the column's place in the trace, below 0 if it has none yet.
void addToColumn(Column& column, const HitOctant& hit, std::int32_t& index, ScanTrace& trace) {
  if (index < 0) {
    index = static_cast<std::int32_t>(trace.columns.size());
    trace.columns.push_back({.column = &column});
  }
  ScanColumn& in = trace.columns[static_cast<std::size_t>(index)];
  const int corner = hit.corner()[2];
  const auto [bottom, top] = layersOf(hit.reached);
  in.z_min = std::min(in.z_min, corner + bottom);
  in.z_max = std::max(in.z_max, corner + top);
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
  ColumnGrid grid(map, sensor, config.reach, config.resolution);
  const std::vector<HitOctant>& hits = octants.list();
  std::array<Place, kAhead> places;
  for (std::size_t first = 0; first < hits.size(); first += kAhead) {
    // The map is larger than the caches: ask for all that a few octants need before it is read.
    const std::size_t n = std::min(kAhead, hits.size() - first);
    for (std::size_t i = 0; i < n; ++i) {
      const OcTreeKey corner = hits[first + i].corner();
      places[i].name = map.nameOf(corner);
      places[i].o = map.octantOf(corner);
      map.prefetch(places[i].name);
    }
    for (std::size_t i = 0; i < n; ++i) {
      Region*& region = places[i].region;
      region = map.find(places[i].name);
      if (region == nullptr) region = &map.getOrCreate(hits[first + i].corner());
      Region::prefetch(region);
    }
    for (std::size_t i = 0; i < n; ++i) {
      Place& place = places[i];
      place.octant = &map.getOrCreate(*place.region, place.o);
      __builtin_prefetch(place.octant);
      __builtin_prefetch(place.region->column);
      __builtin_prefetch(&countsOf(*place.octant).front());
      __builtin_prefetch(&countsOf(*place.octant).back());
    }
    for (std::size_t i = 0; i < n; ++i) {
      const Place& place = places[i];
      const HitOctant& hit = hits[first + i];
      mark(place, hit, trace);
      if (config.insert) insert(place, hit, config.firm);
      if (hit.points > 0)
        if (std::int32_t* index = grid.at(place.region->x, place.region->y))
          addToColumn(*place.region->column, hit, *index, trace);
    }
  }
}

}  // namespace rhmap
