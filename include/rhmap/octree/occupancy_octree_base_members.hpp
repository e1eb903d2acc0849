// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Members of OccupancyOcTreeBase that are more than a line or two; included by occupancy_octree_base.hpp.

#include <algorithm>
#include <bit>
#include <limits>

#include "rhmap/core/region_cursor.hpp"
#include "rhmap/octree/map_codec.hpp"
#include "rhmap/octree/occupancy_octree_base.hpp"
#include "rhmap/octree/ray_cast.hpp"
#include "rhmap/octree/ray_steps.hpp"

namespace rhmap {

// --- whole scans ---

template <class NODE>
ScanMasks OccupancyOcTreeBase<NODE>::mark(const Pointcloud& scan, const point3d& origin, double maxrange,
                                          bool discretize) {
  last_scan_ = {};
  const KeyBox limit = box();
  const ScanMarkingConfig config{
      .max_range = maxrange, .box = use_bbx_limit ? &limit : nullptr, .num_threads = num_threads_};
  if (!discretize) return markScan(this->keys_, scan, origin, config, last_scan_);
  const Pointcloud centres = rhmap::discretize(this->keys_, scan, last_scan_);
  return markScan(this->keys_, centres, origin, config, last_scan_);
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::insertPointCloud(const Pointcloud& scan, const point3d& sensor_origin, double maxrange,
                                                 bool lazy_eval, bool discretize) {
  if (!hasOctomapsRules()) return insertCellByCell(scan, sensor_origin, maxrange, lazy_eval, discretize);
  const ScanMasks marks = mark(scan, sensor_origin, maxrange, discretize);
  if (use_change_detection) {  // has to look at every cell before and after
    marks.forEachCell([&](const OcTreeKey& key, bool occupied) { updateNode(key, occupied, lazy_eval); });
    return;
  }
  ScanApplier<NODE>(*this->store_, sensorModel(), lazy_eval).apply(marks, num_threads_);
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
  if (maxrange > 0 && distance(origin, end) > maxrange)
    return integrateMissOnRay(origin, cutAt(origin, end, maxrange), lazy_eval);
  if (!integrateMissOnRay(origin, end, lazy_eval)) return false;
  updateNode(end, true, lazy_eval);
  return true;
}

template <class NODE>
bool OccupancyOcTreeBase<NODE>::integrateMissOnRay(const point3d& origin, const point3d& end, bool lazy_eval) {
  return forEachRayKey(this->keys_, origin, end, [&](const OcTreeKey& key) { updateNode(key, false, lazy_eval); });
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::insertCellByCell(const Pointcloud& scan, const point3d& origin, double maxrange,
                                                 bool lazy_eval, bool discretize) {
  last_scan_ = {};
  const KeyBox limit = box();
  const ScanMarkingConfig config{.max_range = maxrange, .box = use_bbx_limit ? &limit : nullptr};
  const auto collect = [&](const Pointcloud& points) {
    return collectScan(this->keys_, points, origin, config, last_scan_);
  };
  const ScanCells cells = collect(discretize ? rhmap::discretize(this->keys_, scan, last_scan_) : scan);
  for (const OcTreeKey& key : cells.free) updateNode(key, false, lazy_eval);
  for (const OcTreeKey& key : cells.occupied) updateNode(key, true, lazy_eval);
}

template <class NODE>
template <class KEYS>
void OccupancyOcTreeBase<NODE>::addTo(const ScanMasks& marks, KEYS& free_cells, KEYS& occupied_cells) const {
  marks.forEachCell([&](const OcTreeKey& key, bool occupied) { (occupied ? occupied_cells : free_cells).insert(key); });
  removeOccupied(free_cells, occupied_cells);
}

// --- single cells ---

/// True if an update of cells can be done without asking the object's class: nobody has overridden OctoMap's rules.
template <class NODE>
bool OccupancyOcTreeBase<NODE>::hasOctomapsRules() {
  if constexpr (!structure::kOctomapsInnerValue<NODE>) return false;
  return rules_(*this, [this] {
    using This = OccupancyOcTreeBase;
    const VirtualTable now(*this);
    return this->hasOctomapsStructure() && now.agrees(own_members_, &This::updateNodeLogOdds) &&
           now.agrees(own_members_, static_cast<NODE* (This::*)(const OcTreeKey&, float, bool)>(&This::updateNode)) &&
           now.agrees(own_members_, static_cast<NODE* (This::*)(const OcTreeKey&, bool, bool)>(&This::updateNode));
  });
}

/// `deepest`: the deepest node on the way to the cell that is there already.
template <class NODE>
template <class F>
NODE* OccupancyOcTreeBase<NODE>::changeCell(NodeRef deepest, const OcTreeKey& key, bool lazy_eval, F&& change) {
  bool created = false;
  const NodeRef leaf = structure::reach(*this->store_, deepest, key, kTreeDepth, created, this->expander());
  NODE* node = this->store_->node(leaf);
  this->store_->touch(leaf.block);
  changeLeaf(node, key, created, change);
  if (lazy_eval) return node;
  const NodeRef pruned =
      hasOctomapsRules() ? structure::summariseAbove(*this->store_, leaf, true) : summariseByClass(leaf, NodeRef());
  return pruned ? this->store_->node(pruned) : node;
}

/// The same for the part of the tree below a node, as OctoMap's recursions do it from each node on.
template <class NODE>
template <class F>
NODE* OccupancyOcTreeBase<NODE>::changeCellBelow(NODE* node, bool node_just_created, const OcTreeKey& key,
                                                 unsigned depth, bool lazy_eval, F&& change) {
  bool created = node_just_created;
  if (depth >= kTreeDepth) {
    if (Block* region = this->store_->findRegion(key)) this->store_->touch(region);
    changeLeaf(node, key, created, change);
    return node;
  }
  const NodeRef top = this->store_->locate(node);
  NodeRef deepest = top;
  while (const NodeRef child = structure::childTowards(*this->store_, deepest, key)) {
    deepest = child;
    created = false;
  }
  const NodeRef leaf = structure::reach(*this->store_, deepest, key, kTreeDepth, created, this->expander());
  NODE* cell = this->store_->node(leaf);
  this->store_->touch(leaf.block);
  changeLeaf(cell, key, created, change);
  if (lazy_eval) return cell;
  const NodeRef pruned = summariseByClass(leaf, top);
  return pruned ? this->store_->node(pruned) : cell;
}

template <class NODE>
template <class F>
void OccupancyOcTreeBase<NODE>::changeLeaf(NODE* leaf, const OcTreeKey& key, bool created, F&& change) {
  if (!use_change_detection) return change(leaf);
  const bool occupied_before = this->isNodeOccupied(leaf);
  change(leaf);
  if (created) {
    changed_keys.insert({key, true});
  } else if (occupied_before != this->isNodeOccupied(leaf)) {
    const auto [it, is_new] = changed_keys.insert({key, false});
    if (!is_new && !it->second) changed_keys.erase(it);  // flipped back
  }
}

/// structure::summariseAbove() up to `top`, for a class that has rules of its own.
template <class NODE>
NodeRef OccupancyOcTreeBase<NODE>::summariseByClass(NodeRef child, NodeRef top) {
  NodeRef pruned;
  while (child != top) {
    const NodeRef parent = this->store_->parent(child);
    if (!parent) break;
    if (this->pruneNode(this->store_->node(parent))) {
      pruned = parent;
    } else {
      structure::recompute(*this->store_, parent, this->store_->children(parent));
    }
    child = parent;
  }
  return pruned;
}

template <class NODE>
NODE* OccupancyOcTreeBase<NODE>::updateNode(const OcTreeKey& key, float log_odds_update, bool lazy_eval) {
  const NodeRef deepest = this->store_->deepestToChange(key);
  if (deepest && !this->store_->hasChildren(deepest)) {  // the cell, or a pruned leaf that holds it
    NODE* node = this->store_->node(deepest);
    if (sensorModel().settled(node->getLogOdds(), log_odds_update)) return node;
  }
  return changeCell(deepest, key, lazy_eval, [&](NODE* node) { updateNodeLogOdds(node, log_odds_update); });
}

template <class NODE>
NODE* OccupancyOcTreeBase<NODE>::setNodeValue(const OcTreeKey& key, float log_odds_value, bool lazy_eval) {
  const float value = std::min(std::max(log_odds_value, this->clamping_thres_min), this->clamping_thres_max);
  return changeCell(this->store_->deepestToChange(key), key, lazy_eval, [&](NODE* node) { node->setLogOdds(value); });
}

template <class NODE>
NODE* OccupancyOcTreeBase<NODE>::updateNodeRecurs(NODE* node, bool node_just_created, const OcTreeKey& key,
                                                  unsigned depth, const float& log_odds_update, bool lazy_eval) {
  return changeCellBelow(node, node_just_created, key, depth, lazy_eval,
                         [&](NODE* leaf) { updateNodeLogOdds(leaf, log_odds_update); });
}

template <class NODE>
NODE* OccupancyOcTreeBase<NODE>::setNodeValueRecurs(NODE* node, bool node_just_created, const OcTreeKey& key,
                                                    unsigned depth, const float& log_odds_value, bool lazy_eval) {
  return changeCellBelow(node, node_just_created, key, depth, lazy_eval,
                         [&](NODE* leaf) { leaf->setLogOdds(log_odds_value); });
}

// --- all nodes ---

template <class NODE>
void OccupancyOcTreeBase<NODE>::updateInnerOccupancyRecurs(NODE* node, unsigned depth) {
  const Octet<NODE> children = this->childrenOf(node);
  if (children.mask == 0) return;
  for (unsigned i = 0; i < 8; ++i)
    if (children.has(i)) updateInnerOccupancyRecurs(children.nodes + i, depth + 1);
  structure::recompute(*this->store_, this->store_->locate(node), children);
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::toMaxLikelihoodRecurs(NODE* node, unsigned depth, unsigned max_depth) {
  if (depth == 0) this->store_->touchAll();
  if (depth >= max_depth) return nodeToMaxLikelihood(node);
  const Octet<NODE> children = this->childrenOf(node);
  for (unsigned i = 0; i < 8; ++i)
    if (children.has(i)) toMaxLikelihoodRecurs(children.nodes + i, depth + 1, max_depth);
}

template <class NODE>
void OccupancyOcTreeBase<NODE>::toMaxLikelihood() {
  this->store_->touchAll();
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
[[gnu::flatten]]  // among as much else as is compiled with it, GCC would inline none of the little that its loops do
bool OccupancyOcTreeBase<NODE>::castRay(const point3d& origin, const point3d& direction, point3d& end,
                                        bool ignoreUnknown, double maxRange) const {
  OcTreeKey key;
  if (!this->coordToKeyChecked(origin, key)) return false;
  RegionCursor<NODE> cursor(*this->store_);
  const auto endsIn = [&](const NODE* node) { return node == nullptr ? !ignoreUnknown : this->isNodeOccupied(node); };
  const auto stop = [&](std::uint64_t cell, const NODE* hit) {
    end = this->keyToCoord(cell_word::toKey(cell));
    return hit != nullptr;
  };
  if (const NODE* node = cursor.search(key); endsIn(node)) return stop(cell_word::fromKey(key), node);
  RayCast ray;
  if (!startCast(this->keys_, origin, key, unitVector(direction), ray)) return false;

  // A cell's centre is no farther from where the ray enters than half a diagonal: up to here the range needs no test.
  const double certainly_within =
      maxRange > 0.0 ? (1 - 1e-5) * maxRange - this->getResolution() : std::numeric_limits<double>::infinity();
  const auto isBeyond = [&](const point3d& centre) {
    double squared = 0.0;
    for (unsigned i = 0; i < 3; ++i) squared += double((centre(i) - origin(i)) * (centre(i) - origin(i)));
    return squared > maxRange * maxRange;
  };
  // Borders between cells are no farther from each other, along a ray, than the diagonal of a cell.
  const double farthest_step = 1.7321 * this->getResolution();
  while (true) {
    const bool in_region = cursor.bits() == 0;
    const double to_go = (certainly_within - ray.entry) / farthest_step;
    if (auto steps = static_cast<int>(std::clamp(to_go, 0.0, double(ray.stepsToBorder()))); in_region && steps > 0) {
      RaySteps now(ray);
      for (; steps > 0 && cursor.bits() == 0; --steps) {
        now.take();
        if (const NODE* node = cursor.search(now.cell()); endsIn(node)) return stop(now.cell(), node);
      }
      now.store(ray);
      continue;
    }
    if (!in_region && to_go >= 0) {
      leaveCube(ray, cursor.bits(), certainly_within);
    } else {
      step(ray);
    }
    if (!ray.in_space) return stop(ray.cell(), nullptr);
    if (ray.entry > certainly_within && isBeyond(this->keyToCoord(cell_word::toKey(ray.cell()))))
      return stop(ray.cell(), nullptr);
    if (const NODE* node = cursor.search(ray.cell()); endsIn(node)) return stop(ray.cell(), node);
  }
}

// --- files ---

template <class NODE>
std::ostream& OccupancyOcTreeBase<NODE>::writeBinaryData(std::ostream& s) const {
  return this->store_->empty() ? s : writeBinaryNode(s, this->getRoot());
}

template <class NODE>
std::ostream& OccupancyOcTreeBase<NODE>::writeBinaryNode(std::ostream& s, const NODE* node) const {
  codec::ByteWriter out(s);
  if (const NodeRef at = this->store_->locate(node))
    codec::writeBits(
        *this->store_, at, [this](const NODE& n) { return this->isNodeOccupied(&n); }, out);
  return s;
}

template <class NODE>
std::istream& OccupancyOcTreeBase<NODE>::readBinaryNode(std::istream& s, NODE* node) {
  const NodeRef at = this->store_->locate(node);
  if (!s.good() || !at || this->store_->hasChildren(at)) {
    s.setstate(std::ios::failbit);
    return s;
  }
  try {
    codec::ByteReader in(s);
    codec::readBits(*this->store_, at, this->clamping_thres_min, this->clamping_thres_max, in);
  } catch (const std::runtime_error&) {
    structure::removeBelow(*this->store_, at);
    s.setstate(std::ios::failbit);
  }
  return s;
}

template <class NODE>
std::istream& OccupancyOcTreeBase<NODE>::readBinaryData(std::istream& s) {
  if (!s.good() || !this->store_->empty()) {
    s.setstate(std::ios::failbit);
    return s;
  }
  NODE* root_node = this->store_->node(this->store_->createRoot());
  root_node->setLogOdds(this->clamping_thres_max);  // and so it stays: OctoMap never recomputes it
  if (readBinaryNode(s, root_node).fail()) this->store_->clear();
  return s;
}

}  // namespace rhmap
