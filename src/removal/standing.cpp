// SPDX-License-Identifier: BSD-3-Clause
#include "standing.hpp"

namespace rhmap {

void noteStanding(const ScanTrace& trace, const FreeSpace& free_space, const StandingConfig& config) {
  const int shift = free_space.shift();
  const auto askFor = [](const TracedOctant& at) __attribute__((always_inline)) {
    __builtin_prefetch(&historyOf(*at.octant).first);
  };
  trace.forEachOctant(askFor, [&](const TracedOctant& at) {
    Octant& octant = *at.octant;
    OctantHistory& history = historyOf(octant);
    if (history.first == 0) history.first = trace.scan;
    const auto scansOf = [&](const OcTreeKey& cell) -> std::uint8_t& {
      return history.scans[static_cast<std::size_t>(bitOf(cell)) / 8];
    };
    forEachCell(octant.hit, at.corner, shift, [&](const OcTreeKey& cell, std::uint64_t) { countUp(scansOf(cell)); });
    if (trace.scan - history.first < static_cast<std::uint32_t>(config.time)) return;
    const std::uint64_t cubes = octant.occupied & ~octant.firm & ~octant.doubted;
    forEachCell(cubes, at.corner, shift, [&](const OcTreeKey& cell, std::uint64_t in_cell) {
      const int scans = scansOf(cell);
      if (scans < config.scans) return;
      const double few = config.crossed * scans;
      if (!free_space.isCrossed(cell[0] >> shift, cell[1] >> shift, cell[2] >> shift, few)) octant.firm |= in_cell;
    });
  });
}

}  // namespace rhmap
