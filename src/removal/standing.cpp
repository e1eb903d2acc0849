// SPDX-License-Identifier: BSD-3-Clause
#include "standing.hpp"

namespace rhmap {

void noteStanding(const RegionMap& map, const ScanTrace& trace, const FreeSpace& free_space,
                  const StandingConfig& config, int followed_interval) {
  const int shift = free_space.shift();
  const auto askFor = [](const Region& region, std::size_t o) __attribute__((always_inline)) {
    __builtin_prefetch(&region.past[o].first);
  };
  trace.forEachHitOctant(askFor, [&](const Region& region, std::size_t o, Octant& octant) {
    OctantPast& past = region.past[o];
    countUp(past.scans);
    if (past.first == 0) past.first = trace.scan;
    if (past.scans < config.scans || trace.scan - past.first < static_cast<std::uint32_t>(config.time)) return;
    const auto many = static_cast<unsigned>(config.crossed * past.scans / followed_interval) + 1;
    const std::uint64_t cubes = octant.occupied & ~octant.firm & ~octant.doubted;
    forEachCell(cubes, map.cornerOf(region, o), shift, [&](const OcTreeKey& cell, std::uint64_t in_cell) {
      if (!free_space.isCrossed(cell[0] >> shift, cell[1] >> shift, cell[2] >> shift, many)) octant.firm |= in_cell;
    });
  });
}

}  // namespace rhmap
