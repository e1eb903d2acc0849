// SPDX-License-Identifier: BSD-3-Clause
#include "scan_to_map.hpp"

#include <algorithm>
#include <tuple>

#include "evidence.hpp"

namespace rhmap {
namespace {

constexpr std::size_t kAhead = 8;  // doubts whose memory is asked for before they are judged

/// Cubes of an octant that wait to be looked at; then those that the scan sees through, waiting for judgement.
struct Doubt {
  Region* region;
  std::size_t number;
  Octant* octant;
  std::uint64_t cubes;
  int misses;  // that are needed
};

/// One scan's look at the map: first at all that may have gone, then, with all doubts known, at what stands around.
class ScanToMapRemoval {
 public:
  ScanToMapRemoval(const RegionMap& map, const ScanContext& scan, const RemovalConfig& config, double resolution,
                   const LookConfig& look, RemovalResult& result)
      : map_(map),
        scan_(scan),
        config_(config),
        resolution_(resolution),
        sure_reach_(cubesAround(config.evidence.sure_reach, resolution)),
        enough_(config.evidence.enough / (resolution * resolution)),
        look_(look),
        result_(result) {}

  void run() {
    const std::vector<Column*> columns = columnsOf(scan_.columns);
    std::vector<const Column*> candidates;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Context2d& context = scan_.columns[i];
      Column* column = columns[i];
      if (column == nullptr || !isCandidate(context, *column)) continue;
      candidates.push_back(column);
      // What is lower than all that the scan sees here it does not see.
      for (Region* region : column->regions)
        if ((region->z + 1) << map_.bits() >= context.z_min) lookAt(*region, 1);
    }
    for (const Context3d& context : scan_.regions) lookBetweenBounds(context);
    if (look_.everywhere) lookEverywhere(candidates);
    lookThrough();
    judge();
  }

 private:
  /// Null where there is none. Their memory has been asked for.
  std::vector<Column*> columnsOf(const std::vector<Context2d>& contexts) const {
    std::vector<Column*> columns(contexts.size());
    for (std::size_t i = 0; i < contexts.size(); ++i) {
      if (i + kAhead < contexts.size()) map_.prefetch(contexts[i + kAhead].x, contexts[i + kAhead].y);
      columns[i] = map_.find(contexts[i].x, contexts[i].y);
      __builtin_prefetch(columns[i]);
    }
    return columns;
  }

  /// ratio_1 < delta_1. Eq. (8)
  bool isCandidate(const Context2d& context, Column& column) const {
    const ContextConfig& limits = config_.context;
    if (context.points < limits.min_points || (limits.three_d && context.bulge_dented)) return false;
    if (config_.shrink_heights) map_.refreshHeights(column);
    if (column.h_max < column.h_min) return false;
    const int h_min = std::min<int>(column.h_min, context.z_min), h_max = std::max<int>(column.h_max, context.z_max);
    if (h_max - h_min + 1 < limits.min_height / resolution_) return false;
    return ratio1(context, h_min, h_max, limits.max_ring) < limits.delta_1;
  }

  /// ratio_2 < delta_2 for the region itself; those between its bounds have no points of the scan, so their ratio_2 is
  /// 0. Eqs. (12), (13)
  void lookBetweenBounds(const Context3d& context) {
    Column* column = map_.find(context.x, context.y);
    if (column == nullptr) return;
    for (Region* region : column->regions) {
      const int bottom = region->z << map_.bits(), top = bottom + map_.size() - 1;
      if (region->z == context.z) {
        const auto [low, high] = map_.heights(*region);
        if (low <= high && ratio2(context, low, high) < config_.context.delta_2) lookAt(*region, 1);
      } else if (bottom >= context.inf && top <= context.sup && !has3dContext(context, region->z)) {
        lookAt(*region, 1);
      }
    }
  }

  bool has3dContext(const Context3d& context, key_type z) const {
    const auto less = [](const Context3d& a, const Context3d& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    Context3d at = context;
    at.z = z;
    return std::binary_search(scan_.regions.begin(), scan_.regions.end(), at, less);
  }

  void lookEverywhere(std::vector<const Column*>& candidates) {
    std::sort(candidates.begin(), candidates.end());
    const auto reach = static_cast<float>(config_.context.max_range / resolution_);
    const auto& sensor = scan_.view.origin();
    const auto interval = static_cast<std::uint32_t>(config_.evidence.interval);
    const auto doubtful_interval = static_cast<std::uint32_t>(config_.evidence.doubtful_interval);
    const auto isTurn = [&](key_type x, key_type y) { return turnOf(x, y, look_.scan) % interval == 0; };
    const auto mayBeDue = [&](key_type x, key_type y) {
      if (!isTurn(x, y) && turnOf(x, y, look_.scan) % doubtful_interval != 0) return false;
      const float dx = static_cast<float>(x << map_.bits()) - sensor[0];
      const float dy = static_cast<float>(y << map_.bits()) - sensor[1];
      return dx * dx + dy * dy <= reach * reach;
    };
    const auto isDue = [&](const Column& column) { return column.doubtful || isTurn(column.x, column.y); };
    map_.forEachColumn(mayBeDue, isDue, [&](Column& column) {
      if (std::binary_search(candidates.begin(), candidates.end(), &column)) return;
      column.doubtful = false;
      for (Region* region : column.regions) lookAt(*region, config_.evidence.misses);
    });
  }

  void lookAt(Region& region, int misses) {
    if (misses == 1) {
      result_.is_protected += region.cubes;
    } else if (region.loose_octants == 0 || (!region.doubtful && isHidden(region))) {
      return;
    }
    region.doubtful = false;
    const std::uint32_t turn = turnOf(region.x, region.y, look_.scan);
    const bool all_ground = misses == 1 || turn % static_cast<std::uint32_t>(config_.evidence.ground_interval) == 0;
    forEachBit(region.loose_octants, [&](int number) {
      const auto o = static_cast<std::size_t>(number);
      Octant& octant = region.octant(o);
      region.noteDoubts(o);
      std::uint64_t cubes = octant.occupied & ~octant.safe;
      // With nothing but the ratio to go by, all that is near the ground has to stay.
      if (scan_.visibility == nullptr) cubes &= ~octant.ground;
      if (!all_ground) cubes &= ~octant.ground | octant.doubted;
      if (look_.protect && region.isHitBy(look_.scan, o)) cubes &= ~octant.hit;
      const OcTreeKey corner = map_.cornerOf(region, o);
      if (cubes == 0 || (octant.doubted == 0 && isHidden(corner, 4))) return;
      doubts_.push_back({&region, o, &octant, cubes, misses});
      places_.push_back({corner, cubes});
    });
  }

  bool isHidden(const Region& region) const { return isHidden(map_.cornerOf(region, 0), map_.size()); }

  /// Whether the scan can see through none of so many cubes an axis from a corner on.
  bool isHidden(const OcTreeKey& corner, int size) const {
    if (scan_.visibility == nullptr) return false;
    const float half = static_cast<float>(size - 1) / 2;
    const auto centre = scan_.view(static_cast<float>(corner[0]) + half, static_cast<float>(corner[1]) + half,
                                   static_cast<float>(corner[2]) + half);
    return scan_.visibility->hides(centre, 0.8661F * static_cast<float>(size * resolution_));
  }

  /// Looks at all cubes that wait for it. Notes which the scan sees through, and where it sees something at a cube's
  /// place, takes back the doubts.
  void lookThrough() {
    std::vector<CubeLooks> looks(places_.size());
    if (scan_.visibility == nullptr) {
      for (std::size_t d = 0; d < looks.size(); ++d) looks[d].seen_through = places_[d].cubes;
    } else {
      scan_.visibility->look(scan_.view, places_, looks);
    }
    std::size_t kept = 0;
    for (std::size_t d = 0; d < doubts_.size(); ++d) {
      if (d + kAhead < doubts_.size()) {
        __builtin_prefetch(doubts_[d + kAhead].octant);
        __builtin_prefetch(&historyOf(*doubts_[d + kAhead].octant).filled);
      }
      Doubt doubt = doubts_[d];
      const std::uint64_t filled = looks[d].filled, through = looks[d].seen_through;
      if ((filled | through) == 0) continue;
      Octant& octant = *doubt.octant;
      OctantHistory& history = historyOf(octant);
      forEachBit(through, [&](int bit) { countUp(history.misses[static_cast<std::size_t>(bit)]); });
      forEachBit(filled & octant.doubted, [&](int bit) { history.misses[static_cast<std::size_t>(bit)] = 0; });
      if (const std::uint64_t loose = filled & ~octant.firm; loose != 0) {
        history.filled.countUp(loose);
        octant.firm |= history.filled.atLeast(static_cast<unsigned>(config_.evidence.filled));
      }
      octant.doubted = (octant.doubted & ~filled) | through;
      doubt.region->noteDoubts(doubt.number);
      if (through == 0) continue;
      if (doubt.misses == 1) result_.is_protected -= static_cast<std::size_t>(popcount(through));
      doubt.cubes = through;
      doubts_[kept++] = doubt;
    }
    doubts_.resize(kept);
  }

  void judge() {
    std::vector<std::uint64_t> gone(doubts_.size(), 0);
    const EvidenceConfig& evidence = config_.evidence;
    for (std::size_t d = 0; d < doubts_.size(); ++d) {
      if (d + kAhead < doubts_.size()) {
        __builtin_prefetch(&historyOf(*doubts_[d + kAhead].octant).hits);
        __builtin_prefetch(&historyOf(*doubts_[d + kAhead].octant).misses);
      }
      const Doubt& doubt = doubts_[d];
      const OctantHistory& history = historyOf(*doubt.octant);
      std::uint64_t seen = 0, due = 0, sure = 0;
      forEachBit(doubt.cubes, [&](int bit) {
        const int hits = history.hits[static_cast<std::size_t>(bit)],
                  misses = history.misses[static_cast<std::size_t>(bit)];
        if (look_.revert_hits > 0 && hits >= look_.revert_hits) return;
        seen |= maskOf(bit);
        if (misses >= doubt.misses) due |= maskOf(bit);
        if (misses >= std::max<double>(evidence.sure_misses, evidence.sure_ratio * hits)) sure |= maskOf(bit);
      });
      if (seen == 0) continue;
      const Neighbourhood around = doubtedAround(doubt, kFarthestAround);
      if (around.firm == 0 && around.moving >= enough_) gone[d] |= seen;
      if (around.isMoving(evidence.share)) gone[d] |= due;
      if ((sure & ~gone[d]) != 0 && doubtedAround(doubt, sure_reach_).isMoving(evidence.sure_share)) gone[d] |= sure;
    }
    for (std::size_t d = 0; d < doubts_.size(); ++d) {
      const Doubt& doubt = doubts_[d];
      gone[d] &= doubt.octant->occupied;  // a region may have been looked at twice
      if (gone[d] == 0) continue;
      doubt.region->remove(doubt.number, gone[d]);
      result_.removed.push_back({map_.cornerOf(*doubt.region, doubt.number), gone[d], scan_.visibility != nullptr});
    }
  }

  Neighbourhood doubtedAround(const Doubt& doubt, int reach) const {
    return lookAround(map_, map_.cornerOf(*doubt.region, doubt.number), reach,
                      [](const Region& region, std::size_t o) { return region.octant(o).doubted; });
  }

  const RegionMap& map_;
  const ScanContext& scan_;
  const RemovalConfig& config_;
  double resolution_;
  int sure_reach_;  // in cubes
  double enough_;   // cubes
  const LookConfig& look_;
  RemovalResult& result_;
  std::vector<Doubt> doubts_;
  std::vector<CubesAt> places_;  // of the doubts
};

}  // namespace

void removeByScan(const RegionMap& map, const ScanContext& scan, const RemovalConfig& config, double resolution,
                  const LookConfig& look, RemovalResult& result) {
  ScanToMapRemoval(map, scan, config, resolution, look, result).run();
}

}  // namespace rhmap
