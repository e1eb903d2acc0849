// SPDX-License-Identifier: BSD-3-Clause
#include "void_rejection.hpp"

namespace rhmap {

std::size_t rejectInVoid(const RegionMap& map, const GroundEstimation& ground, const ScanTrace& trace,
                         const CellGrid& voids, int shift, const std::deque<std::shared_ptr<const ScanContext>>& past, const LookBack& look_back, const VoidConfig& config, double resolution,
                         std::vector<RemovedOctant>& removed) {
  // Cells with hits above the ground, and those of them that lie in the void.
  CellGrid solid(voids.x0(), voids.y0(), voids.z0(), voids.side());
  CellGrid moving = solid;
  const auto grown_ground = static_cast<float>(config.grown_ground / resolution);
  const auto above = [&](const Region& region, int o) {  // hits that may be taken out
    const Octant& octant = region.octants[static_cast<std::size_t>(o)];
    std::uint64_t cubes = octant.hit & ~octant.ground;
    const std::uint64_t low = octant.hit & octant.ground;
    if (low != 0 && config.grown_ground >= 0) {
      const Column* column = map.find(region.x, region.y);
      const OcTreeKey corner = map.cornerOf(region, o);
      forEachBit(low, [&](int bit) {
        const auto height = ground.heightAbove(map, *column, cubeOf(corner, bit));
        if (height && *height > grown_ground) cubes |= std::uint64_t{1} << bit;
      });
    }
    return cubes;
  };
  bool any = false;
  for (const Region* region : trace.regions) {
    std::array<std::uint64_t, 64> appeared_in{};
    if (look_back.enabled) {
      int t = 0, s = 0;
      for (int o = 0; o < map.octants(); ++o) {
        const Octant& octant = region->octants[static_cast<std::size_t>(o)];
        const std::uint64_t fresh = octant.fresh & ~octant.ground;
        const OcTreeKey corner = map.cornerOf(*region, o);
        forEachBit(fresh, [&](int bit) {
          int seen = 0;
          for (const auto& scan : past) seen += scan->visibility.seesThrough(scan->view(cubeOf(corner, bit)));
          if (seen >= look_back.need) appeared_in[o] |= std::uint64_t{1} << bit;
        });
        t += std::popcount(appeared_in[o]);
        s += std::popcount(octant.occupied & ~octant.ground & ~appeared_in[o]);
      }
      if (t < look_back.share * (t + s)) appeared_in = {};
    }
    for (int o = 0; o < map.octants(); ++o) {
      const Octant& octant = region->octants[static_cast<std::size_t>(o)];
      const std::uint64_t cubes = octant.hit & ~octant.ground;
      if (octant.hit == 0) continue;
      const std::uint64_t appeared = appeared_in[o];
      forEachCell(octant.hit, map.cornerOf(*region, o), shift, [&](const OcTreeKey& corner, std::uint64_t hit, int) {
        const int x = corner[0] >> shift, y = corner[1] >> shift, z = corner[2] >> shift;
        solid.set(x, y, z);
        if (((cubes & hit) != 0 && voids.at(x, y, z)) || (appeared & hit) != 0) {
          moving.set(x, y, z);
          any = true;
        }
      });
    }
  }
  if (!any) return 0;
  for (int step = 0; step < config.growth; ++step) {
    CellGrid grown = moving.dilated();
    for (int y = 0; y < grown.side(); ++y)
      for (int x = 0; x < grown.side(); ++x) grown.word(x, y) &= solid.word(x, y);
    moving = std::move(grown);
  }
  for (int step = 0; step < config.down; ++step) {
    for (int y = 0; y < moving.side(); ++y)
      for (int x = 0; x < moving.side(); ++x) moving.word(x, y) |= (moving.word(x, y) >> 1) & solid.word(x, y);
  }
  std::size_t rejected = 0;
  for (Region* region : trace.regions) {
    for (int o = 0; o < map.octants(); ++o) {
      Octant& octant = region->octants[static_cast<std::size_t>(o)];
      if (octant.hit == 0) continue;
      const OcTreeKey corner = map.cornerOf(*region, o);
      std::uint64_t in = 0;
      forEachCell(octant.hit, corner, shift, [&](const OcTreeKey& c, std::uint64_t hit, int) {
        if (moving.at(c[0] >> shift, c[1] >> shift, c[2] >> shift)) in |= hit;
      });
      if (in == 0) continue;
      std::uint64_t out = above(*region, o) & octant.occupied & in;
      if (config.known < 255) forEachBit(out, [&](int bit) { if (octant.hits[bit] > config.known) out &= ~(std::uint64_t{1} << bit); });
      if (out == 0) continue;
      rejected += static_cast<std::size_t>(std::popcount(out));
      octant.occupied &= ~out;
      octant.ground &= ~out;
      if (const std::uint64_t known = out & ~octant.fresh; known != 0) removed.push_back({corner, known, false});
      forEachBit(out, [&](int bit) { if (g_dbg) { auto k = cubeOf(corner, bit); g_dbg->push_back({k[0],k[1],k[2],(octant.fresh>>bit&1)?1:2,octant.hits[bit],g_scan}); } octant.hits[static_cast<std::size_t>(bit)] = 0; });
      map.find(region->x, region->y)->stale = true;
    }
  }
  return rejected;
}

}  // namespace rhmap
