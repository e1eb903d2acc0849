// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Members of OccupancyOcTreeBase that are more than a line or two; included by occupancy_octree_base.hpp.

#include "rhmap/core/region_cursor.hpp"
#include "rhmap/octree/map_codec.hpp"
#include "rhmap/octree/occupancy_octree_base.hpp"

namespace rhmap {

// --- whole scans ---

template <class NODE>
ScanMasks OccupancyOcTreeBase<NODE>::mark(const Pointcloud& scan, const point3d& origin, double maxrange,
                                          bool discretize) {
  last_scan_ = {};
  const ScanMarkingConfig config{
      .max_range = maxrange, .box = use_bbx_limit_ ? &box_ : nullptr, .num_threads = num_threads_};
  if (!discretize) return markScan(this->keys_, scan, origin, config, last_scan_);
  const Pointcloud centres = rhmap::discretize(this->keys_, scan, last_scan_);
  return markScan(this->keys_, centres, origin, config, last_scan_);
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::insertPointCloud(const Pointcloud& scan, const point3d& sensor_origin, double maxrange,
                                                 bool lazy_eval, bool discretize) {
  const ScanMasks marks = mark(scan, sensor_origin, maxrange, discretize);
  if (use_change_detection_) {  // has to look at every cell before and after
    marks.forEachCell([&](const OcTreeKey& key, bool occupied) { updateNode(key, occupied, lazy_eval); });
    return;
  }
  ScanApplier<NODE> applier(*this->store_, sensorModel(), lazy_eval);
  marks.forEachRegion([&](const RegionMasks& region) { applier.apply(region); });
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::insertPointCloud(const Pointcloud& scan, const point3d& sensor_origin,
                                                 const pose6d& frame_origin, double maxrange, bool lazy_eval,
                                                 bool discretize) {
  Pointcloud in_map(scan);
  in_map.transform(frame_origin);
  insertPointCloud(in_map, frame_origin.transform(sensor_origin), maxrange, lazy_eval, discretize);
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::insertPointCloud(const ScanNode& scan, double maxrange, bool lazy_eval,
                                                 bool discretize) {
  const point3d in_own_frame = scan.pose.inv().transform(scan.pose.trans());
  insertPointCloud(*scan.scan, in_own_frame, scan.pose, maxrange, lazy_eval, discretize);
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::insertPointCloudRays(const Pointcloud& scan, const point3d& sensor_origin,
                                                     double /*maxrange*/, bool lazy_eval) {
  for (const point3d& p : scan) insertRay(sensor_origin, p, -1.0, lazy_eval);
}

template <class NODE>
bool OccupancyOcTreeBase<NODE>::insertRay(const point3d& origin, const point3d& end, double maxrange, bool lazy_eval) {
  const auto miss = [&](const OcTreeKey& key) { updateNode(key, false, lazy_eval); };
  if (maxrange > 0 && distance(origin, end) > maxrange)
    return forEachRayKey(this->keys_, origin, cutAt(origin, end, maxrange), miss);
  if (!forEachRayKey(this->keys_, origin, end, miss)) return false;
  updateNode(end, true, lazy_eval);
  return true;
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::addTo(const ScanMasks& marks, KeySet& free_cells, KeySet& occupied_cells) const {
  marks.forEachCell([&](const OcTreeKey& key, bool occupied) { (occupied ? occupied_cells : free_cells).insert(key); });
  for (auto it = free_cells.begin(); it != free_cells.end();)
    it = occupied_cells.count(*it) != 0 ? free_cells.erase(it) : std::next(it);
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::computeUpdate(const Pointcloud& scan, const point3d& origin, KeySet& free_cells,
                                              KeySet& occupied_cells, double maxrange) {
  addTo(mark(scan, origin, maxrange, false), free_cells, occupied_cells);
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::computeDiscreteUpdate(const Pointcloud& scan, const point3d& origin, KeySet& free_cells,
                                                      KeySet& occupied_cells, double maxrange) {
  addTo(mark(scan, origin, maxrange, true), free_cells, occupied_cells);
}

// --- single cells ---

/// `deepest`: the deepest node on the way to the cell that is there already.
template <class NODE>
template <class F>
NODE* OccupancyOcTreeBase<NODE>::changeCell(NodeRef deepest, const OcTreeKey& key, bool lazy_eval, F&& change) {
  bool created;
  const NodeRef leaf = structure::reach(*this->store_, deepest, key, kTreeDepth, created);
  NODE* node = this->store_->node(leaf);
  if (use_change_detection_) {
    const bool occupied_before = this->isNodeOccupied(node);
    change(node);
    noteChange(key, created, occupied_before != this->isNodeOccupied(node));
  } else {
    change(node);
  }
  if (lazy_eval) return node;
  const NodeRef pruned = structure::summariseAbove(*this->store_, leaf);
  if (!pruned) return node;
  return this->store_->node(pruned);
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::noteChange(const OcTreeKey& key, bool created, bool flipped) {
  if (created) {
    changed_keys_.insert({key, true});
  } else if (flipped) {
    const auto [it, is_new] = changed_keys_.insert({key, false});
    if (!is_new && !it->second) changed_keys_.erase(it);  // flipped back
  }
}

template <class NODE>
NODE* OccupancyOcTreeBase<NODE>::updateNode(const OcTreeKey& key, float log_odds_update, bool lazy_eval) {
  const NodeRef deepest = this->store_->deepest(key);
  if (deepest && !this->store_->hasChildren(deepest)) {  // the cell, or a pruned leaf that holds it
    NODE* node = this->store_->node(deepest);
    if (sensorModel().settled(node->getLogOdds(), log_odds_update)) return node;
  }
  return changeCell(deepest, key, lazy_eval, [&](NODE* node) { updateNodeLogOdds(node, log_odds_update); });
}

template <class NODE>
NODE* OccupancyOcTreeBase<NODE>::setNodeValue(const OcTreeKey& key, float log_odds_value, bool lazy_eval) {
  const float value = std::min(std::max(log_odds_value, this->clamping_thres_min), this->clamping_thres_max);
  return changeCell(this->store_->deepest(key), key, lazy_eval, [&](NODE* node) { node->setLogOdds(value); });
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::toMaxLikelihood() {
  this->store_->forEachBlock([&](Block& block) {
    for (int o = 0; o < kOctets; ++o) {
      if (block.mask[static_cast<std::size_t>(o)] == 0) continue;
      const Octet<NODE> octet = this->store_->octet(&block, o);
      for (unsigned i = 0; i < 8; ++i)
        if (octet.has(i)) nodeToMaxLikelihood(octet.nodes + i);
    }
  });
}

// --- rays into the map ---

template <class NODE>
bool OccupancyOcTreeBase<NODE>::castRay(const point3d& origin, const point3d& direction, point3d& end,
                                        bool ignoreUnknown, double maxRange) const {
  OcTreeKey key;
  if (!this->coordToKeyChecked(origin, key)) return false;
  RegionCursor<NODE> cursor(*this->store_);
  const NODE* start = cursor.search(key);
  if (start == nullptr ? !ignoreUnknown : this->isNodeOccupied(start)) {
    end = this->keyToCoord(key);
    return start != nullptr;
  }
  std::optional<Ray> ray = startCast(this->keys_, origin, key, unitVector(direction));
  if (!ray) return false;

  const auto beyond = [&](const point3d& centre) {
    double squared = 0.0;
    for (unsigned i = 0; i < 3; ++i) squared += double((centre(i) - origin(i)) * (centre(i) - origin(i)));
    return squared > maxRange * maxRange;
  };
  const auto stop = [&](bool hit) {
    end = this->keyToCoord(ray->key);
    return hit;
  };
  // A cell's centre is no farther from where the ray enters than a diagonal: up to here the range needs no test.
  const double certainly_within = maxRange - (2 * this->getResolution() + 1e-5 * maxRange);
  for (;;) {
    const int axis = ray->nextAxis();
    const key_type k = ray->key[static_cast<unsigned>(axis)];
    if (ray->step[axis] < 0 ? k == 0 : k == 2 * kTreeMaxVal - 1) return stop(false);  // the border of the key space
    const double entry = ray->t_max[axis];
    ray->advance(axis);
    if (maxRange > 0.0 && entry > certainly_within && beyond(this->keyToCoord(ray->key))) return stop(false);
    const NODE* node = cursor.search(ray->key);
    if (node == nullptr ? !ignoreUnknown : this->isNodeOccupied(node)) return stop(node != nullptr);
  }
}

// --- files ---

template <class NODE>
std::ostream& OccupancyOcTreeBase<NODE>::writeBinaryData(std::ostream& s) const {
  codec::ByteWriter out(s);
  if (const NodeRef root = this->store_->root())
    codec::writeBits(
        *this->store_, root, [this](const NODE& node) { return this->isNodeOccupied(&node); }, out);
  return s;
}

template <class NODE>
std::istream& OccupancyOcTreeBase<NODE>::readBinaryData(std::istream& s) {
  if (!s.good() || !this->store_->empty()) {
    s.setstate(std::ios::failbit);
    return s;
  }
  try {
    const NodeRef root = this->store_->createRoot();
    this->store_->node(root)->setLogOdds(this->clamping_thres_max);  // and so it stays: OctoMap never recomputes it
    codec::readBits(*this->store_, root, this->clamping_thres_min, this->clamping_thres_max, s);
  } catch (const std::runtime_error&) {
    this->store_->clear();
    s.setstate(std::ios::failbit);
  }
  return s;
}

}  // namespace rhmap
