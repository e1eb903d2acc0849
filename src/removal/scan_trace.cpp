// SPDX-License-Identifier: BSD-3-Clause
#include "scan_trace.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rhmap {
namespace {

constexpr std::size_t kAhead = 12;     // octants between two steps
constexpr std::size_t kInFlight = 64;  // more than in all steps together
static_assert(kInFlight > 3 * kAhead);

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
  // The map is larger than the caches. What an octant needs is asked for step by step, each some octants after the one
  // before has asked for what it reads: the entry in the hash table, the region, the octant.
  std::array<TracedOctant, kInFlight> places;
  std::array<std::uint64_t, kInFlight> names;  // of their regions
  const auto name = [&](std::size_t i) {
    TracedOctant& at = places[i % kInFlight];
    at.corner = hits[i].corner();
    at.number = static_cast<std::uint16_t>(map.octantOf(at.corner));
    names[i % kInFlight] = map.nameOf(at.corner);
    map.prefetch(names[i % kInFlight]);
  };
  const auto findRegion = [&](std::size_t i) {
    TracedOctant& at = places[i % kInFlight];
    const std::uint64_t region = names[i % kInFlight];
    const bool as_before = i > 0 && region == names[(i - 1) % kInFlight];
    at.region = as_before ? places[(i - 1) % kInFlight].region : map.find(region);
    if (at.region == nullptr) at.region = &map.getOrCreate(at.corner);
    Region::prefetch(at.region);
  };
  const auto findOctant = [&](std::size_t i) {
    TracedOctant& at = places[i % kInFlight];
    at.octant = &map.getOrCreate(*at.region, at.number);
    __builtin_prefetch(at.octant);
    __builtin_prefetch(at.region->column);
    __builtin_prefetch(&historyOf(*at.octant).hits);
  };
  for (std::size_t i = 0; i < hits.size() + 3 * kAhead; ++i) {
    if (i < hits.size()) name(i);
    if (i >= kAhead && i - kAhead < hits.size()) findRegion(i - kAhead);
    if (i >= 2 * kAhead && i - 2 * kAhead < hits.size()) findOctant(i - 2 * kAhead);
    if (i < 3 * kAhead) continue;
    const HitOctant& hit = hits[i - 3 * kAhead];
    const TracedOctant& at = places[(i - 3 * kAhead) % kInFlight];
    mark(at, hit, trace);
    if (config.insert) insert(at, config.firm);
    if (hit.points > 0)
      if (std::int32_t* index = grid.at(at.region->x, at.region->y)) addToColumn(at, hit, *index, trace);
  }
}

}  // namespace rhmap
