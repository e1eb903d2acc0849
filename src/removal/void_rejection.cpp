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
  if (look_back.enabled) {
    for (Region* region : trace.regions) {
      int t = 0, s = 0;
      for (int o = 0; o < map.octants(); ++o) {
        Octant& octant = region->octants[static_cast<std::size_t>(o)];
        const std::uint64_t fresh = octant.fresh & ~octant.ground;
        const OcTreeKey corner = map.cornerOf(*region, o);
        forEachBit(fresh, [&](int bit) {
          int seen = 0;
          for (const auto& scan : past) seen += scan->visibility.seesThrough(scan->view(cubeOf(corner, bit)));
          if (seen >= look_back.need) octant.appeared |= std::uint64_t{1} << bit;
        });
        t += std::popcount(octant.appeared);
        s += std::popcount(octant.occupied & ~octant.ground & ~octant.appeared);
      }
      if (t < look_back.share * (t + s)) for (int o = 0; o < map.octants(); ++o) region->octants[o].appeared = 0;
    }
  }
  for (const Region* region : trace.regions) {
    for (int o = 0; o < map.octants(); ++o) {
      const Octant& octant = region->octants[static_cast<std::size_t>(o)];
      const std::uint64_t cubes = octant.hit & ~octant.ground;
      if (octant.hit == 0) continue;
      std::uint64_t appeared = octant.appeared;
      if (appeared != 0 && look_back.around > 0) {
        int tn = 0, sn = 0;
        const OcTreeKey c = map.cornerOf(*region, o);
        for (int dx = -1; dx <= 1; ++dx) for (int dy = -1; dy <= 1; ++dy) for (int dz = -1; dz <= 1; ++dz) {
          if (std::abs(dx) + std::abs(dy) + std::abs(dz) > look_back.around) continue;
          const Region* r = map.find(key_type((c[0] + 4 * dx) >> map.bits()), key_type((c[1] + 4 * dy) >> map.bits()), key_type((c[2] + 4 * dz) >> map.bits()));
          if (r == nullptr) continue;
          const Octant& n = r->octants[map.octantOf(OcTreeKey(c[0] + 4 * dx, c[1] + 4 * dy, c[2] + 4 * dz))];
          const std::uint64_t app = r->scan == trace.scan ? n.appeared : 0;
          tn += std::popcount(app);
          sn += std::popcount(n.occupied & n.firm & ~n.ground & ~app & ~n.doubted);
        }
        if (tn < look_back.around_share * (tn + sn)) appeared = 0;
      }
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
      octant.firm &= ~out;
      octant.doubted &= ~out;
      if (const std::uint64_t known = out & ~octant.fresh; known != 0) removed.push_back({corner, known, false});
      forEachBit(out, [&](int bit) { if (g_dbg) { auto k = cubeOf(corner, bit); g_dbg->push_back({k[0],k[1],k[2],(octant.fresh>>bit&1)?1:2,octant.hits[bit],g_scan}); } octant.hits[static_cast<std::size_t>(bit)] = 0; });
      map.find(region->x, region->y)->stale = true;
    }
  }
  return rejected;
}

}  // namespace rhmap
