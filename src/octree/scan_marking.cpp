// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/scan_marking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include "rhmap/octree/parallel.hpp"
#include "rhmap/octree/ray.hpp"
#include "rhmap/octree/ray_start.hpp"
#include "rhmap/octree/ray_walk.hpp"

namespace rhmap {
namespace {

bool isFinite(const point3d& p) { return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()); }

/// First and last key along each axis that the rays of this scan can reach; nothing if that may be outside of the tree.
std::optional<std::pair<OcTreeKey, OcTreeKey>> reachOf(const KeySpace& keys, const octomap::Pointcloud& scan,
                                                       const point3d& origin, double max_range) {
  constexpr int kMargin = 8;  // cells: a ray may miss its end by a rounding, and leave the box by a cell
  point3d low = origin, high = origin;
  for (const point3d& p : scan) {
    for (unsigned axis = 0; axis < 3; ++axis) {  // a NaN compares false
      low(axis) = p(axis) < low(axis) ? p(axis) : low(axis);
      high(axis) = p(axis) > high(axis) ? p(axis) : high(axis);
    }
  }
  const double margin = kMargin * keys.resolution();
  const auto reach = max_range < 0 ? std::numeric_limits<double>::infinity() : max_range;
  OcTreeKey min, max;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const double from = std::max<double>(low(axis), origin(axis) - reach) - margin;
    const double to = std::min<double>(high(axis), origin(axis) + reach) + margin;
    if (!keys.coordToKeyChecked(from, min[axis]) || !keys.coordToKeyChecked(to, max[axis])) return std::nullopt;
  }
  return std::pair(min, max);
}

/// What OctoMap makes of a point: a ray that frees the cells on its way, and the cell that is hit.
struct PointRay {
  point3d end;
  std::optional<OcTreeKey> hit;
};

/// Nothing for a point that is not finite.
std::optional<PointRay> rayOf(const KeySpace& keys, const point3d& p, const point3d& origin,
                              const ScanMarkingConfig& config) {
  if (!isFinite(p)) return std::nullopt;
  const bool in_range = config.max_range < 0.0 || distance(origin, p) <= config.max_range;
  PointRay ray{in_range ? p : cutAt(origin, p, config.max_range), std::nullopt};
  OcTreeKey key;
  if (in_range && (config.box == nullptr || config.box->contains(p)) && keys.coordToKeyChecked(p, key)) ray.hit = key;
  return ray;
}

/// Marks parts of a scan: one thread's work.
class Marker {
 public:
  Marker(const KeySpace& keys, const point3d& origin, const ScanMarkingConfig& config, ScanMasks masks)
      : keys_(keys), origin_(origin), config_(config), masks_(std::move(masks)) {}

  void add(std::span<const point3d> points) {
    counts_.points += points.size();
    if (config_.box != nullptr) {
      for (const point3d& p : points) addInBox(p, *config_.box);
      return;
    }
    while (!points.empty()) {
      const auto next = points.first(std::min(points.size(), batch_->room()));
      points = points.subspan(next.size());
      const RayCounts counts = startRays(start_, next, *batch_, *hits_);
      counts_.not_finite += counts.not_finite;
      counts_.outside += counts.outside;
      for (std::size_t i = 0; i < hits_->size; ++i) masks_.markHit(hits_->cell[i]);
      hits_->size = 0;
      if (!points.empty() && batch_->room() > RayBatch::kCapacity / 4) continue;  // many rays keep the lanes busy
      walkRays(*batch_, masks_);
      batch_->clear();
    }
  }

  ScanMasks& masks() { return masks_; }
  const ScanCounts& counts() const { return counts_; }

 private:
  void addInBox(const point3d& p, const KeyBox& box) {
    const std::optional<PointRay> ray = rayOf(keys_, p, origin_, config_);
    if (!ray) {
      ++counts_.not_finite;
      return;
    }
    bool inside = true;
    const bool crossed = forEachRayKey(keys_, origin_, ray->end, [&](const OcTreeKey& key) {
      inside = inside && box.contains(key);
      if (inside) masks_.markFree(key);
    });
    if (!crossed) ++counts_.outside;
    if (ray->hit) masks_.markHit(*ray->hit);
  }

  const KeySpace& keys_;
  const point3d& origin_;
  const ScanMarkingConfig& config_;
  RayOrigin start_{keys_, origin_, config_.max_range};
  std::unique_ptr<RayBatch> batch_ = std::make_unique_for_overwrite<RayBatch>();
  std::unique_ptr<HitCells> hits_ = std::make_unique_for_overwrite<HitCells>();
  ScanMasks masks_;
  ScanCounts counts_;
};

}  // namespace

ScanMasks markScan(const KeySpace& keys, const octomap::Pointcloud& scan, const point3d& origin,
                   const ScanMarkingConfig& config, ScanCounts& counts) {
  constexpr std::size_t kPart = 4096;  // points that a thread takes at a time: some are much longer than others
  const std::span<const point3d> points(scan.size() == 0 ? nullptr : &scan[0], scan.size());
  const std::size_t parts = (points.size() + kPart - 1) / kPart;
  const std::size_t threads =
      std::clamp(parts, std::size_t{1}, static_cast<std::size_t>(std::max(config.num_threads, 1)));
  const auto reach = reachOf(keys, scan, origin, config.max_range);
  std::vector<std::optional<Marker>> markers(threads);  // each made by its thread, whose memory it is in then
  forEachPart(parts, threads, [&](std::size_t part, std::size_t thread) {
    std::optional<Marker>& marker = markers[thread];
    if (!marker) marker.emplace(keys, origin, config, reach ? ScanMasks(reach->first, reach->second) : ScanMasks());
    marker->add(points.subspan(part * kPart, std::min(kPart, points.size() - part * kPart)));
  });

  ScanMasks masks;
  for (std::optional<Marker>& marker : markers) {
    if (!marker) continue;
    counts.points += marker->counts().points;
    counts.not_finite += marker->counts().not_finite;
    counts.outside += marker->counts().outside;
    masks.merge(std::move(marker->masks()));
  }
  return masks;
}

ScanCells collectScan(const KeySpace& keys, const octomap::Pointcloud& scan, const point3d& origin,
                      const ScanMarkingConfig& config, ScanCounts& counts) {
  ScanCells cells;
  std::vector<OcTreeKey> crossed;
  for (const point3d& p : scan) {
    ++counts.points;
    const std::optional<PointRay> ray = rayOf(keys, p, origin, config);
    if (!ray) {
      ++counts.not_finite;
      continue;
    }
    crossed.clear();
    if (!forEachRayKey(keys, origin, ray->end, [&](const OcTreeKey& key) { crossed.push_back(key); })) ++counts.outside;
    const auto leaves_box = [&](const OcTreeKey& key) { return config.box != nullptr && !config.box->contains(key); };
    cells.free.insert(crossed.begin(), std::find_if(crossed.begin(), crossed.end(), leaves_box));
    if (ray->hit) cells.occupied.insert(*ray->hit);
  }
  removeOccupied(cells.free, cells.occupied);
  return cells;
}

octomap::Pointcloud discretize(const KeySpace& keys, const octomap::Pointcloud& scan, ScanCounts& counts) {
  octomap::Pointcloud centres;
  centres.reserve(scan.size());
  std::unordered_set<OcTreeKey, OcTreeKey::KeyHash> seen;
  for (const point3d& p : scan) {
    if (!isFinite(p)) {
      ++counts.points;
      ++counts.not_finite;
      continue;
    }
    const OcTreeKey key(keys.coordToKey(p.x()), keys.coordToKey(p.y()), keys.coordToKey(p.z()));
    if (seen.insert(key).second) centres.push_back(keys.keyToCoord(key));
  }
  return centres;
}

}  // namespace rhmap
