// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/Pointcloud.h>
#include <octomap/ScanGraph.h>

#include <algorithm>

#include "rhmap/octree/abstract_occupancy_octree.hpp"
#include "rhmap/octree/octree_base.hpp"
#include "rhmap/octree/scan_apply.hpp"
#include "rhmap/octree/scan_marking.hpp"

namespace rhmap {

using octomap::KeyBoolMap;
using octomap::Pointcloud;
using octomap::pose6d;
using octomap::ScanNode;

/// A tree of occupancy nodes, under OctoMap's names and with OctoMap's answers.
///
/// Lengths in metres, poses sensor to map. Where a call says `lazy_eval`, inner nodes are neither recomputed nor
/// pruned: call updateInnerOccupancy() (and prune()) when done. Points that are not finite or not inside the tree are
/// skipped; lastScan() counts them.
template <class NODE>
class OccupancyOcTreeBase : public OcTreeBaseImpl<NODE, AbstractOccupancyOcTree> {
  using Base = OcTreeBaseImpl<NODE, AbstractOccupancyOcTree>;

 public:
  explicit OccupancyOcTreeBase(double resolution) : Base(resolution) {}
  OccupancyOcTreeBase(const OccupancyOcTreeBase&) = default;

  // --- whole scans ---

  /// Inserts a scan, each cell once: the cells that rays end in are hit, the other cells that rays cross are missed.
  /// Points and origin in the map's frame; rays are cut at `maxrange` (negative: no limit). `discretize` keeps one ray
  /// for each end cell, to its centre.
  void insertPointCloud(const Pointcloud& scan, const point3d& sensor_origin, double maxrange = -1.,
                        bool lazy_eval = false, bool discretize = false);
  /// Points and origin in a frame with this pose in the map.
  void insertPointCloud(const Pointcloud& scan, const point3d& sensor_origin, const pose6d& frame_origin,
                        double maxrange = -1., bool lazy_eval = false, bool discretize = false);
  /// Points in the sensor's frame, with the sensor's pose.
  void insertPointCloud(const ScanNode& scan, double maxrange = -1., bool lazy_eval = false, bool discretize = false);

  /// Inserts ray by ray, so that a cell is updated as often as rays cross it. As in OctoMap `maxrange` has no effect.
  void insertPointCloudRays(const Pointcloud& scan, const point3d& sensor_origin, double maxrange = -1.,
                            bool lazy_eval = false);

  /// One ray: misses up to `end`, a hit there. Longer than `maxrange` (> 0): misses up to there only. False if an end
  /// is outside of the tree.
  bool insertRay(const point3d& origin, const point3d& end, double maxrange = -1.0, bool lazy_eval = false);

  /// The cells that insertPointCloud would miss and hit, added to what is in the sets already; no cell stays in both.
  void computeUpdate(const Pointcloud& scan, const point3d& origin, KeySet& free_cells, KeySet& occupied_cells,
                     double maxrange);
  void computeDiscreteUpdate(const Pointcloud& scan, const point3d& origin, KeySet& free_cells, KeySet& occupied_cells,
                             double maxrange);

  /// Threads that insertPointCloud and computeUpdate may use (1 or more). The map is the same with any number.
  void setNumThreads(int n) { num_threads_ = std::max(n, 1); }
  int getNumThreads() const { return num_threads_; }

  /// What became of the points of the last insertPointCloud or computeUpdate.
  const ScanCounts& lastScan() const { return last_scan_; }

  // --- single cells ---

  /// Adds to a cell's log-odds, within the clamping. Returns its node, or the pruned one that it became part of.
  NODE* updateNode(const OcTreeKey& key, float log_odds_update, bool lazy_eval = false) override;
  NODE* updateNode(const point3d& p, float log_odds_update, bool lazy_eval = false) override {
    return at(p, [&](const OcTreeKey& key) { return updateNode(key, log_odds_update, lazy_eval); });
  }
  NODE* updateNode(double x, double y, double z, float log_odds_update, bool lazy_eval = false) {
    return at(x, y, z, [&](const OcTreeKey& key) { return updateNode(key, log_odds_update, lazy_eval); });
  }
  /// A hit or a miss.
  NODE* updateNode(const OcTreeKey& key, bool occupied, bool lazy_eval = false) override {
    return updateNode(key, occupied ? this->prob_hit_log : this->prob_miss_log, lazy_eval);
  }
  NODE* updateNode(const point3d& p, bool occupied, bool lazy_eval = false) override {
    return at(p, [&](const OcTreeKey& key) { return updateNode(key, occupied, lazy_eval); });
  }
  NODE* updateNode(double x, double y, double z, bool occupied, bool lazy_eval = false) {
    return at(x, y, z, [&](const OcTreeKey& key) { return updateNode(key, occupied, lazy_eval); });
  }

  /// Sets a cell's log-odds, clamped.
  NODE* setNodeValue(const OcTreeKey& key, float log_odds_value, bool lazy_eval = false);
  NODE* setNodeValue(const point3d& p, float log_odds_value, bool lazy_eval = false) {
    return at(p, [&](const OcTreeKey& key) { return setNodeValue(key, log_odds_value, lazy_eval); });
  }
  NODE* setNodeValue(double x, double y, double z, float log_odds_value, bool lazy_eval = false) {
    return at(x, y, z, [&](const OcTreeKey& key) { return setNodeValue(key, log_odds_value, lazy_eval); });
  }

  /// Every node, inner ones too, by its own value: to the upper clamping threshold if occupied, else to the lower.
  void toMaxLikelihood() override;
  /// Recomputes all inner nodes from their children, without pruning.
  void updateInnerOccupancy() { structure::updateInner(*this->store_); }

  void integrateHit(NODE* node) const { updateNodeLogOdds(node, this->prob_hit_log); }
  void integrateMiss(NODE* node) const { updateNodeLogOdds(node, this->prob_miss_log); }
  /// Adds to a node's log-odds, within the clamping.
  void updateNodeLogOdds(NODE* node, const float& update) const {
    node->setLogOdds(sensorModel().updated(node->getLogOdds(), update));
  }
  void nodeToMaxLikelihood(NODE* node) const {
    node->setLogOdds(this->isNodeOccupied(node) ? this->clamping_thres_max : this->clamping_thres_min);
  }
  void nodeToMaxLikelihood(NODE& node) const { nodeToMaxLikelihood(&node); }

  // --- rays into the map ---

  /// Follows a ray until it enters an occupied cell: true, and `end` is that cell's centre. False, with `end` the
  /// centre of the cell where it stopped: beyond `maxRange` (> 0), in an unknown cell (unless ignored), at the border
  /// of the key space. False with `end` untouched: origin outside of the tree, or no direction.
  bool castRay(const point3d& origin, const point3d& direction, point3d& end, bool ignoreUnknown = false,
               double maxRange = -1.0) const;

  // --- limits of insertPointCloud ---

  void useBBXLimit(bool enable) { use_bbx_limit_ = enable; }
  bool bbxSet() const { return use_bbx_limit_; }
  void setBBXMin(const point3d& min) {
    box_.min = min;
    this->coordToKeyChecked(min, box_.min_key);
  }
  void setBBXMax(const point3d& max) {
    box_.max = max;
    this->coordToKeyChecked(max, box_.max_key);
  }
  point3d getBBXMin() const { return box_.min; }
  point3d getBBXMax() const { return box_.max; }
  point3d getBBXBounds() const {
    point3d half = box_.max - box_.min;
    half /= 2.0F;
    return half;
  }
  point3d getBBXCenter() const { return box_.min + getBBXBounds(); }
  bool inBBX(const point3d& p) const { return box_.contains(p); }
  bool inBBX(const OcTreeKey& key) const { return box_.contains(key); }

  // --- change detection ---

  /// Remembers the cells that appear (true) or change between free and occupied (false) by updates of cells.
  void enableChangeDetection(bool enable) { use_change_detection_ = enable; }
  bool isChangeDetectionEnabled() const { return use_change_detection_; }
  void resetChangeDetection() { changed_keys_.clear(); }
  KeyBoolMap::const_iterator changedKeysBegin() const { return changed_keys_.begin(); }
  KeyBoolMap::const_iterator changedKeysEnd() const { return changed_keys_.end(); }
  std::size_t numChangesDetected() const { return changed_keys_.size(); }

  // --- files ---

  std::istream& readBinaryData(std::istream& s) override;
  std::ostream& writeBinaryData(std::ostream& s) const override;

 protected:
  SensorModel sensorModel() const {
    return {this->prob_hit_log, this->prob_miss_log, this->clamping_thres_min, this->clamping_thres_max};
  }

 private:
  template <class F>
  NODE* at(const point3d& p, F&& action) {
    return at(p.x(), p.y(), p.z(), action);
  }
  template <class F>
  NODE* at(double x, double y, double z, F&& action) {
    OcTreeKey key;
    return this->coordToKeyChecked(x, y, z, key) ? action(key) : nullptr;
  }

  ScanMasks mark(const Pointcloud& scan, const point3d& origin, double maxrange, bool discretize);
  void addTo(const ScanMasks& marks, KeySet& free_cells, KeySet& occupied_cells) const;
  template <class F>
  NODE* changeCell(NodeRef deepest, const OcTreeKey& key, bool lazy_eval, F&& change);
  void noteChange(const OcTreeKey& key, bool created, bool flipped);

  bool use_bbx_limit_ = false;
  KeyBox box_{{}, {}, {0, 0, 0}, {0, 0, 0}};
  bool use_change_detection_ = false;
  KeyBoolMap changed_keys_;
  int num_threads_ = 1;
  ScanCounts last_scan_;
};

}  // namespace rhmap

#include "rhmap/octree/occupancy_octree_base_members.hpp"
