// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/scan_marking.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "rhmap/octree/ray.hpp"
#include "rhmap/octree/ray_walk.hpp"

namespace rhmap {
namespace {

bool isFinite(const point3d& p) { return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()); }

/// First and last key along each axis that the rays of this scan can reach; nothing if that may be outside of the tree.
std::optional<std::pair<OcTreeKey, OcTreeKey>> reachOf(const KeySpace& keys, const octomap::Pointcloud& scan,
                                                       const point3d& origin, double max_range) {
  constexpr int kMargin = 8;  // cells: a ray may miss its end by a rounding, and leave the box by a cell
  OcTreeKey min, max;
  for (unsigned axis = 0; axis < 3; ++axis) {
    double low = origin(axis);
    double high = low;
    for (const point3d& p : scan) {  // a NaN compares false
      low = p(axis) < low ? double(p(axis)) : low;
      high = p(axis) > high ? double(p(axis)) : high;
    }
    if (max_range >= 0) {
      low = std::max(low, origin(axis) - max_range);
      high = std::min(high, origin(axis) + max_range);
    }
    const double margin = kMargin * keys.resolution();
    if (!keys.coordToKeyChecked(low - margin, min[axis]) || !keys.coordToKeyChecked(high + margin, max[axis]))
      return std::nullopt;
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

/// Marks part of a scan: one thread's work.
class Marker {
 public:
  Marker(const KeySpace& keys, const point3d& origin, const ScanMarkingConfig& config, ScanMasks masks)
      : keys_(keys), origin_(origin), config_(config), batch_(std::make_unique_for_overwrite<RayBatch>()), masks_(std::move(masks)) {}

  void add(const point3d& p) {
    ++counts_.points;
    const std::optional<PointRay> ray = rayOf(keys_, p, origin_, config_);
    if (!ray) {
      ++counts_.not_finite;
      return;
    }
    const bool crossed = config_.box == nullptr ? free(ray->end) : freeInBox(ray->end, *config_.box);
    if (!crossed) ++counts_.outside;
    if (ray->hit) masks_.markHit(*ray->hit);
  }

  void finish() {
    walkRays(*batch_, masks_);
    batch_->clear();
  }

  ScanMasks& masks() { return masks_; }
  const ScanCounts& counts() const { return counts_; }

 private:
  bool free(const point3d& end) {
    RaySegment ray;
    const RayStart start = startSegment(keys_, origin_, end, ray);
    if (start == RayStart::kRay) {
      batch_->add(ray);
      if (batch_->full()) finish();
    }
    return start != RayStart::kOutside;
  }

  bool freeInBox(const point3d& end, const KeyBox& box) {
    bool inside = true;
    return forEachRayKey(keys_, origin_, end, [&](const OcTreeKey& key) {
      inside = inside && box.contains(key);
      if (inside) masks_.markFree(key);
    });
  }

  const KeySpace& keys_;
  const point3d& origin_;
  const ScanMarkingConfig& config_;
  std::unique_ptr<RayBatch> batch_;
  ScanMasks masks_;
  ScanCounts counts_;
};

}  // namespace

ScanMasks markScan(const KeySpace& keys, const octomap::Pointcloud& scan, const point3d& origin,
                   const ScanMarkingConfig& config, ScanCounts& counts) {
  const auto parts = static_cast<std::size_t>(config.num_threads < 1 ? 1 : config.num_threads);
  std::vector<Marker> markers;
  markers.reserve(parts);
  const auto reach = reachOf(keys, scan, origin, config.max_range);
  for (std::size_t i = 0; i < parts; ++i)
    markers.emplace_back(keys, origin, config, reach ? ScanMasks(reach->first, reach->second) : ScanMasks());

  std::exception_ptr error;
#pragma omp parallel for num_threads(static_cast <int>(parts)) if (parts > 1)
  for (std::size_t part = 0; part < parts; ++part) {
    try {
      for (std::size_t i = scan.size() * part / parts; i < scan.size() * (part + 1) / parts; ++i)
        markers[part].add(scan[static_cast<unsigned>(i)]);
      markers[part].finish();
    } catch (...) {
#pragma omp critical(rhmap_mark_scan)
      error = std::current_exception();
    }
  }
  if (error) std::rethrow_exception(error);

  for (const Marker& marker : markers) {
    counts.points += marker.counts().points;
    counts.not_finite += marker.counts().not_finite;
    counts.outside += marker.counts().outside;
  }
  for (std::size_t i = 1; i < parts; ++i) markers[0].masks().merge(markers[i].masks());
  return std::move(markers[0].masks());
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
