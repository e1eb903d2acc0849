// SPDX-License-Identifier: BSD-3-Clause
#include "leftovers.hpp"

#include <algorithm>
#include <utility>
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

/// Finds octants that may hold leftovers.
class LooseOctants {
 public:
  LooseOctants(const RegionMap& map, const LookConfig& look) : map_(map), look_(look) {}

  void addAround(std::span<const OcTreeKey> octants) {
    for (const OcTreeKey& corner : octants)
      forEachOctantAround(map_, corner, [&](Region& region, std::size_t o, int, int, int) { add(region, o); });
  }

  void addThinnedColumns(int interval) {
    const auto isTurn = [&](key_type x, key_type y) {
      return turnOf(x, y, look_.scan) % static_cast<std::uint32_t>(interval) == 0;
    };
    const auto isThinned = [](const Column& column) { return column.thinned; };
    map_.forEachColumn(isTurn, isThinned, [&](const Column& column) {
      for (Region* region : column.regions)
        forEachBit(region->loose_octants, [&](int o) { add(*region, static_cast<std::size_t>(o)); });
    });
  }

  /// Each once.
  std::vector<LooseOctant> take() {
    std::sort(found_.begin(), found_.end(), [](const LooseOctant& a, const LooseOctant& b) { return a.name < b.name; });
    found_.erase(std::unique(found_.begin(), found_.end(),
                             [](const LooseOctant& a, const LooseOctant& b) { return a.name == b.name; }),
                 found_.end());
    return std::move(found_);
  }

 private:
  void add(Region& region, std::size_t o) {
    if ((region.loose_octants >> o & 1) == 0) return;
    const Octant& octant = region.octant(o);
    std::uint64_t cubes = octant.occupied & ~octant.ground & ~octant.firm;
    if (look_.protect && region.isHitBy(look_.scan, o)) cubes &= ~octant.hit;
    if (cubes != 0) found_.push_back({cell_word::fromKey(map_.cornerOf(region, o)), &region, o, cubes});
  }

  const RegionMap& map_;
  const LookConfig& look_;
  std::vector<LooseOctant> found_;
};

/// Of some cubes, those that scans are known to have hit, and not just read from the tree.
std::uint64_t knownHits(const Tally& hits, std::uint64_t cubes) {
  std::uint64_t known = 0;
  forEachBit(cubes, [&](int bit) { known |= std::uint64_t{hits[static_cast<std::size_t>(bit)] > 0} << bit; });
  return known;
}

}  // namespace

void removeLeftovers(const RegionMap& map, std::span<const OcTreeKey> changed, int interval,
                     const LeftoverConfig& config, double resolution, const LookConfig& look, RemovalResult& result) {
  const int reach = cubesAround(config.reach, resolution);
  const double least = config.least / (resolution * resolution);
  LooseOctants loose(map, look);
  loose.addAround(changed);
  if (interval > 0) loose.addThinnedColumns(interval);
  std::vector<LooseOctant> octants = loose.take();
  std::erase_if(octants, [&](const LooseOctant& octant) {
    const Neighbourhood near =
        lookAround(map, map.cornerOf(*octant.region, octant.octant), reach, [](const Region& region, std::size_t o) {
          return historyOf(region.octant(o)).gone & ~region.octant(o).occupied;
        });
    return near.moving < least || !near.isMoving(config.share, config.others);
  });
  for (const LooseOctant& octant : octants) {  // all were found before any goes
    const std::uint64_t cubes = knownHits(historyOf(octant.region->octant(octant.octant)).hits, octant.cubes);
    if (cubes == 0) continue;
    octant.region->remove(octant.octant, cubes);
    result.removed.push_back({map.cornerOf(*octant.region, octant.octant), cubes, false});
  }
}

}  // namespace rhmap
