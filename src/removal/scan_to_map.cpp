// SPDX-License-Identifier: BSD-3-Clause
#include "scan_to_map.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "ground.hpp"

namespace rhmap {
std::vector<std::array<int,8>>* g_dbg=nullptr; int g_reason=0; int g_scan=0;

double ratio1(int scan_min, int scan_max, int map_min, int map_max) {
  return double(scan_max - scan_min + 1) / double(map_max - map_min + 1);
}

namespace {

struct Judge {
  RegionMap& map;
  const ScanContext& scan;
  const RemovalConfig& config;
  double resolution;
  std::uint32_t protect_scan;
  int revert_hits;
  const GroundEstimation& ground;
  RemovalResult& result;
  int reason;

  void column(Column& column, int z_from, const Verdict& verdict) {
    const float gexc = static_cast<float>(config.free_space.grown_ground / resolution);
    for (const auto& region : column.regions) {
      if (((region->z + 1) << map.bits()) <= z_from) continue;
      int region_t = 0, region_s = 0, region_h = 0;
      std::array<std::uint64_t, 64> cand{}, seen{};
      for (int o = 0; o < map.octants(); ++o) {
        Octant& octant = region->octants[static_cast<std::size_t>(o)];
        if (octant.occupied == 0) continue;
        std::uint64_t candidates = octant.occupied & ~octant.ground;
        const OcTreeKey corner = map.cornerOf(*region, o);
        if (config.sweep.ground && (octant.occupied & octant.ground) != 0) {
          forEachBit(octant.ground & octant.occupied, [&](int bit) {
            const auto h = ground.heightAbove(map, column, cubeOf(corner, bit));
            if (h && *h > gexc) candidates |= std::uint64_t{1} << bit;
          });
        }
        std::uint64_t through = 0, bad = 0;
        const std::uint64_t now = config.protect_hits && region->scan == protect_scan ? octant.hit : 0;
        forEachBit(candidates & ~now, [&](int bit) {
          auto& missed = octant.missed[static_cast<std::size_t>(bit)];
          if (!config.visibility.enabled || scan.visibility.seesThrough(scan.view(cubeOf(corner, bit)))) {
            missed = static_cast<std::uint8_t>(missed + (missed < 255));
            through |= std::uint64_t{1} << bit;
            octant.doubted |= std::uint64_t{1} << bit;
          }
          if (missed > 0) bad |= std::uint64_t{1} << bit;
        });
        cand[o] = through;
        seen[o] = bad;
        region_t += std::popcount(bad);
        region_s += std::popcount(candidates & ~bad);
        region_h += std::popcount(now & candidates);
      }
      if (region_t == 0) continue;
      const double region_share = region_t / double(region_t + region_s + config.sweep.hit_weight * region_h);
      const Verdict& sure = config.sweep.sure;
      if (region_share < verdict.region_share && region_share < sure.region_share) continue;
      for (int o = 0; o < map.octants(); ++o) {
        if (cand[o] == 0) continue;
        Octant& octant = region->octants[static_cast<std::size_t>(o)];
        const int t = std::popcount(seen[o]), s = std::popcount(octant.occupied & ~octant.ground & ~seen[o]);
        double octant_share = t / double(t + s);
        if (config.sweep.around > 0) {
          int tn = 0, sn = 0;
          const OcTreeKey c = map.cornerOf(*region, o);
          for (int dx = -1; dx <= 1; ++dx) for (int dy = -1; dy <= 1; ++dy) for (int dz = -1; dz <= 1; ++dz) {
            if (config.sweep.around == 1 && std::abs(dx) + std::abs(dy) + std::abs(dz) > 1) continue;
            if (config.sweep.around == 2 && std::abs(dx) + std::abs(dy) + std::abs(dz) > 2) continue;
            const Octant* n = map.findOctant(OcTreeKey(c[0] + 4 * dx, c[1] + 4 * dy, c[2] + 4 * dz));
            if (n == nullptr) continue;
            tn += std::popcount(n->occupied & n->doubted);
            sn += std::popcount(n->occupied & n->firm & ~n->doubted & ~n->ground);
          }
          octant_share = tn / double(tn + sn);
        }
        const bool first = region_share >= verdict.region_share && octant_share >= verdict.octant_share;
        const bool second = region_share >= sure.region_share && octant_share >= sure.octant_share;
        std::uint64_t gone = 0;
        forEachBit(cand[o], [&](int bit) {
          const int hits = octant.hits[static_cast<std::size_t>(bit)];
          if (revert_hits > 0 && hits >= revert_hits) return;
          const int m = octant.missed[static_cast<std::size_t>(bit)];
          if ((first && m >= verdict.misses + verdict.per_hit * std::min(double(hits), verdict.cap)) || (second && m >= sure.misses + sure.per_hit * std::min(double(hits), sure.cap))) gone |= std::uint64_t{1} << bit;
        });
        if (gone == 0) continue;
        octant.occupied &= ~gone; octant.doubted &= ~gone; octant.firm &= ~gone;
        octant.ground &= ~gone;
        forEachBit(gone, [&](int bit) { if (g_dbg) { auto k = cubeOf(map.cornerOf(*region, o), bit); g_dbg->push_back({k[0],k[1],k[2],reason,octant.hits[bit],g_scan,octant.missed[bit]}); } octant.hits[static_cast<std::size_t>(bit)] = 0; octant.missed[static_cast<std::size_t>(bit)] = 0; });
        column.stale = true;
        result.removed.push_back({map.cornerOf(*region, o), gone, true});
      }
    }
  }
};

}  // namespace

void removeByScan(RegionMap& map, const ScanContext& scan, const RemovalConfig& config, double resolution,
                  std::uint32_t protect_scan, int revert_hits, bool late, const GroundEstimation& ground, RemovalResult& result) {
  const ContextConfig& limits = config.context;
  const double min_height = limits.min_height / resolution;
  Judge judge{map, scan, config, resolution, protect_scan, revert_hits, ground, result, late ? 5 : 3};
  std::set<Column*> done;
  for (const ColumnContext& context : scan.columns) {
    if (context.points < limits.min_points) continue;
    Column* column = map.find(context.x, context.y);
    if (column == nullptr) continue;
    if (config.shrink_heights) map.refreshHeights(*column);
    if (column->h_max < column->h_min) continue;
    const int h_min = std::min(column->h_min, context.z_min);
    int h_max = std::max(column->h_max, context.z_max);
    if (context.max_ring) h_max = context.z_max;
    if (h_max - h_min + 1 < min_height) continue;
    if (ratio1(context.z_min, context.z_max, h_min, h_max) >= limits.delta_1) continue;
    done.insert(column);
    judge.column(*column, context.z_min - 1, late ? config.sweep.late : config.sweep.ratio);
  }
  if (!config.sweep.enabled || (late && !config.sweep.late_other)) return;
  judge.reason = late ? 6 : 4;
  const float reach = static_cast<float>(config.sweep.max_range);
  map.forEachColumn([&](Column& column) {
    const float dx = (static_cast<float>(column.x << map.bits()) - scan.view.origin()[0]) * static_cast<float>(resolution);
    const float dy = (static_cast<float>(column.y << map.bits()) - scan.view.origin()[1]) * static_cast<float>(resolution);
    if (dx * dx + dy * dy > reach * reach) return;
    if (done.count(&column)) return;
    judge.column(column, 0, config.sweep.other);
  });
}

}  // namespace rhmap
