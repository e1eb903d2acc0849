// SPDX-License-Identifier: BSD-3-Clause
#include "leftovers.hpp"

#include <algorithm>
#include <vector>

#include "evidence.hpp"
#include "rhmap/core/cell_word.hpp"

namespace rhmap {
namespace {

/// An octant with cubes that few scans have hit.
struct LooseOctant {
  std::uint64_t name;  // the order in which they are judged, whatever the order of those that have changed
  Region* region;
  std::size_t octant;
  std::uint64_t cubes;
};

/// The octants at and beside some that have such cubes, each once.
std::vector<LooseOctant> octantsBeside(const RegionMap& map, std::span<const OcTreeKey> octants,
                                       const LookConfig& look) {
  std::vector<LooseOctant> found;
  for (const OcTreeKey& corner : octants) {
    forEachOctantAround(map, corner, [&](Region& region, std::size_t o, int, int, int) {
      if ((region.loose_octants >> o & 1) == 0) return;
      const Octant& octant = region.octants[o];
      std::uint64_t cubes = octant.occupied & ~octant.ground & ~octant.firm;
      if (look.protect && region.scan == look.scan) cubes &= ~octant.hit;
      if (cubes != 0) found.push_back({cell_word::fromKey(map.cornerOf(region, o)), &region, o, cubes});
    });
  }
  std::sort(found.begin(), found.end(), [](const LooseOctant& a, const LooseOctant& b) { return a.name < b.name; });
  found.erase(std::unique(found.begin(), found.end(),
                          [](const LooseOctant& a, const LooseOctant& b) { return a.name == b.name; }),
              found.end());
  return found;
}

/// Of some cubes, those that scans are known to have hit, and not just read from the tree.
std::uint64_t knownHits(const OctantCounts& counts, std::uint64_t cubes) {
  std::uint64_t known = 0;
  forEachBit(cubes, [&](int bit) { known |= std::uint64_t{counts[static_cast<std::size_t>(bit)].hits > 0} << bit; });
  return known;
}

}  // namespace

void removeLeftovers(const RegionMap& map, std::span<const OcTreeKey> around, const LeftoverConfig& config,
                     double resolution, const LookConfig& look, RemovalResult& result) {
  const int reach = cubesAround(config.reach, resolution);
  const double least = config.least / (resolution * resolution);
  std::vector<LooseOctant> octants = octantsBeside(map, around, look);
  std::erase_if(octants, [&](const LooseOctant& octant) {
    const Neighbourhood near = lookAround(
        map, map.cornerOf(*octant.region, octant.octant), reach,
        [](const Region& region, std::size_t o) { return region.past[o].gone & ~region.octants[o].occupied; });
    return near.moving < least || !near.isMoving(config.share, config.others);
  });
  for (const LooseOctant& octant : octants) {  // all were found before any goes
    const std::uint64_t cubes = knownHits(octant.region->counts[octant.octant], octant.cubes);
    if (cubes == 0) continue;
    octant.region->remove(octant.octant, cubes);
    result.removed.push_back({map.cornerOf(*octant.region, octant.octant), cubes, false});
  }
}

}  // namespace rhmap
