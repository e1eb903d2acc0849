// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/Pointcloud.h>
#include <octomap/ScanGraph.h>

#include <algorithm>

#include "rhmap/octree/abstract_occupancy_octree.hpp"
#include "rhmap/octree/octree_base.hpp"
#include "rhmap/octree/overrides.hpp"
#include "rhmap/octree/scan_apply.hpp"
#include "rhmap/octree/scan_marking.hpp"
#include "rhmap/octree/surface.hpp"

namespace rhmap {

using octomap::KeyBoolMap;
using octomap::Pointcloud;
using octomap::pose6d;
using octomap::ScanNode;

/// A tree of occupancy nodes, under OctoMap's names and with OctoMap's answers. NODE is OcTreeNode or derived from it.
///
/// Subclasses may override what is virtual, as with OctoMap. Where they change the rules of a cell's update
/// (updateNode, updateNodeLogOdds, expandNode, pruneNode, isNodeCollapsible, or the node's own
/// updateOccupancyChildren), scans go through these members cell by cell, in OctoMap's order.
///
/// Lengths in metres, poses sensor to map. Where a call says `lazy_eval`, inner nodes are neither recomputed nor
/// pruned: call updateInnerOccupancy() (and prune()) when done. Points that are not finite or not inside the tree are
/// skipped; lastScan() counts them.
template <class NODE>
class OccupancyOcTreeBase : public OcTreeBaseImpl<NODE, AbstractOccupancyOcTree> {
  using Base = OcTreeBaseImpl<NODE, AbstractOccupancyOcTree>;

 public:
  OccupancyOcTreeBase(double resolution) : Base(resolution), own_members_(*this) {}  // NOLINT: implicit, as OctoMap's
  OccupancyOcTreeBase(const OccupancyOcTreeBase&) = default;

  // --- whole scans ---

  /// Inserts a scan, each cell once: the cells that rays end in are hit, the other cells that rays cross are missed.
  /// Points and origin in the map's frame; rays are cut at `maxrange` (negative: no limit). `discretize` keeps one ray
  /// for each end cell, to its centre.
  virtual void insertPointCloud(const Pointcloud& scan, const point3d& sensor_origin, double maxrange = -1.,
                                bool lazy_eval = false, bool discretize = false);
  /// Points and origin in a frame with this pose in the map.
  virtual void insertPointCloud(const Pointcloud& scan, const point3d& sensor_origin, const pose6d& frame_origin,
                                double maxrange = -1., bool lazy_eval = false, bool discretize = false);
  /// Points in the sensor's frame, with the sensor's pose.
  virtual void insertPointCloud(const ScanNode& scan, double maxrange = -1., bool lazy_eval = false,
                                bool discretize = false);

  /// Inserts ray by ray, so that a cell is updated as often as rays cross it. As in OctoMap `maxrange` has no effect.
  virtual void insertPointCloudRays(const Pointcloud& scan, const point3d& sensor_origin, double maxrange = -1.,
                                    bool lazy_eval = false);

  /// One ray: misses up to `end`, a hit there. Longer than `maxrange` (> 0): misses up to there only. False if an end
  /// is outside of the tree.
  virtual bool insertRay(const point3d& origin, const point3d& end, double maxrange = -1.0, bool lazy_eval = false);

  /// The cells that insertPointCloud would miss and hit, added to what is in the sets already; no cell stays in both.
  /// KEYS: rhmap::KeySet, or OctoMap's own (a std::unordered_set).
  template <class KEYS>
  void computeUpdate(const Pointcloud& scan, const point3d& origin, KEYS& free_cells, KEYS& occupied_cells,
                     double maxrange) {
    addTo(mark(scan, origin, maxrange, false), free_cells, occupied_cells);
  }
  template <class KEYS>
  void computeDiscreteUpdate(const Pointcloud& scan, const point3d& origin, KEYS& free_cells, KEYS& occupied_cells,
                             double maxrange) {
    addTo(mark(scan, origin, maxrange, true), free_cells, occupied_cells);
  }

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
  virtual NODE* updateNode(double x, double y, double z, float log_odds_update, bool lazy_eval = false) {
    return at(x, y, z, [&](const OcTreeKey& key) { return updateNode(key, log_odds_update, lazy_eval); });
  }
  /// A hit or a miss.
  NODE* updateNode(const OcTreeKey& key, bool occupied, bool lazy_eval = false) override {
    return updateNode(key, occupied ? this->prob_hit_log : this->prob_miss_log, lazy_eval);
  }
  NODE* updateNode(const point3d& p, bool occupied, bool lazy_eval = false) override {
    return at(p, [&](const OcTreeKey& key) { return updateNode(key, occupied, lazy_eval); });
  }
  virtual NODE* updateNode(double x, double y, double z, bool occupied, bool lazy_eval = false) {
    return at(x, y, z, [&](const OcTreeKey& key) { return updateNode(key, occupied, lazy_eval); });
  }

  /// Sets a cell's log-odds, clamped.
  virtual NODE* setNodeValue(const OcTreeKey& key, float log_odds_value, bool lazy_eval = false);
  virtual NODE* setNodeValue(const point3d& p, float log_odds_value, bool lazy_eval = false) {
    return at(p, [&](const OcTreeKey& key) { return setNodeValue(key, log_odds_value, lazy_eval); });
  }
  virtual NODE* setNodeValue(double x, double y, double z, float log_odds_value, bool lazy_eval = false) {
    return at(x, y, z, [&](const OcTreeKey& key) { return setNodeValue(key, log_odds_value, lazy_eval); });
  }

  /// Every node, inner ones too, by its own value: to the upper clamping threshold if occupied, else to the lower.
  void toMaxLikelihood() override;
  /// Recomputes all inner nodes from their children, without pruning.
  void updateInnerOccupancy() { structure::updateInner(*this->store_); }

  virtual void integrateHit(NODE* node) const { updateNodeLogOdds(node, this->prob_hit_log); }
  virtual void integrateMiss(NODE* node) const { updateNodeLogOdds(node, this->prob_miss_log); }
  /// Adds to a node's log-odds, within the clamping.
  virtual void updateNodeLogOdds(NODE* node, const float& update) const {
    node->setLogOdds(sensorModel().updated(node->getLogOdds(), update));
  }
  virtual void nodeToMaxLikelihood(NODE* node) const {
    node->setLogOdds(this->isNodeOccupied(node) ? this->clamping_thres_max : this->clamping_thres_min);
  }
  virtual void nodeToMaxLikelihood(NODE& node) const { nodeToMaxLikelihood(&node); }

  // --- rays into the map ---

  /// Follows a ray until it enters an occupied cell: true, and `end` is that cell's centre. False, with `end` the
  /// centre of the cell where it stopped: beyond `maxRange` (> 0), in an unknown cell (unless ignored), at the border
  /// of the key space. False with `end` untouched: origin outside of the tree, or no direction.
  virtual bool castRay(const point3d& origin, const point3d& direction, point3d& end, bool ignoreUnknown = false,
                       double maxRange = -1.0) const;

  /// Unit normals, towards free space, of the surface around the cell at `point`: marching cubes. False, with none,
  /// if the point is outside of the tree. `unknownStatus`: unknown cells count as occupied.
  bool getNormals(const point3d& point, std::vector<point3d>& normals, bool unknownStatus = true) const {
    return surfaceNormals(
        *this->store_, this->keys_, point, unknownStatus,
        [this](const NODE* node) { return this->isNodeOccupied(node); }, normals);
  }

  /// Where a ray enters the cell (of depth 16) with this centre, and `delta` (in lengths of `direction`) further on: to
  /// sharpen castRay's answer. False, with `intersection` untouched, if it misses the cell. As in OctoMap a cell behind
  /// the origin is met, too, on its far side.
  virtual bool getRayIntersection(const point3d& origin, const point3d& direction, const point3d& center,
                                  point3d& intersection, double delta = 0.0) const {
    return intersectCell(this->getResolution(), origin, direction, center, delta, intersection);
  }

  // --- limits of insertPointCloud ---

  void useBBXLimit(bool enable) { use_bbx_limit = enable; }
  bool bbxSet() const { return use_bbx_limit; }
  void setBBXMin(const point3d& min) {
    bbx_min = min;
    this->coordToKeyChecked(min, bbx_min_key);
  }
  void setBBXMax(const point3d& max) {
    bbx_max = max;
    this->coordToKeyChecked(max, bbx_max_key);
  }
  point3d getBBXMin() const { return bbx_min; }
  point3d getBBXMax() const { return bbx_max; }
  point3d getBBXBounds() const {
    point3d half = bbx_max - bbx_min;
    half /= 2.0F;
    return half;
  }
  point3d getBBXCenter() const { return bbx_min + getBBXBounds(); }
  bool inBBX(const point3d& p) const { return box().contains(p); }
  bool inBBX(const OcTreeKey& key) const { return box().contains(key); }

  // --- change detection ---

  /// Remembers the cells that appear (true) or change between free and occupied (false) by updates of cells.
  void enableChangeDetection(bool enable) { use_change_detection = enable; }
  bool isChangeDetectionEnabled() const { return use_change_detection; }
  void resetChangeDetection() { changed_keys.clear(); }
  KeyBoolMap::const_iterator changedKeysBegin() const { return changed_keys.begin(); }
  KeyBoolMap::const_iterator changedKeysEnd() const { return changed_keys.end(); }
  std::size_t numChangesDetected() const { return changed_keys.size(); }

  // --- files ---

  std::istream& readBinaryData(std::istream& s) override;
  std::ostream& writeBinaryData(std::ostream& s) const override;
  /// What lies below a node, as in a .bt file. Reading needs a node without children and above depth 16; on bad data
  /// the stream fails and the node is left without children.
  std::istream& readBinaryNode(std::istream& s, NODE* node);
  std::ostream& writeBinaryNode(std::ostream& s, const NODE* node) const;

 protected:
  // OctoMap's names, for subclasses.
  NODE* updateNodeRecurs(NODE* node, bool node_just_created, const OcTreeKey& key, unsigned depth,
                         const float& log_odds_update, bool lazy_eval = false);
  NODE* setNodeValueRecurs(NODE* node, bool node_just_created, const OcTreeKey& key, unsigned depth,
                           const float& log_odds_value, bool lazy_eval = false);
  void updateInnerOccupancyRecurs(NODE* node, unsigned depth);
  void toMaxLikelihoodRecurs(NODE* node, unsigned depth, unsigned max_depth);
  bool integrateMissOnRay(const point3d& origin, const point3d& end, bool lazy_eval = false);

  bool use_bbx_limit = false;
  point3d bbx_min, bbx_max;
  OcTreeKey bbx_min_key{0, 0, 0}, bbx_max_key{0, 0, 0};
  bool use_change_detection = false;
  KeyBoolMap changed_keys;

  KeyBox box() const { return {bbx_min, bbx_max, bbx_min_key, bbx_max_key}; }

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
  template <class KEYS>
  void addTo(const ScanMasks& marks, KEYS& free_cells, KEYS& occupied_cells) const;
  void insertCellByCell(const Pointcloud& scan, const point3d& origin, double maxrange, bool lazy_eval,
                        bool discretize);

  bool hasOctomapsRules();
  template <class F>
  NODE* changeCell(NodeRef deepest, const OcTreeKey& key, bool lazy_eval, F&& change);
  template <class F>
  NODE* changeCellBelow(NODE* node, bool node_just_created, const OcTreeKey& key, unsigned depth, bool lazy_eval,
                        F&& change);
  template <class F>
  void changeLeaf(NODE* leaf, const OcTreeKey& key, bool created, F&& change);
  NodeRef summariseByClass(NodeRef child, NodeRef top);

  int num_threads_ = 1;
  ScanCounts last_scan_;
  VirtualTable own_members_;  // before any subclass overrides them
  PerClass rules_;
};

}  // namespace rhmap

#include "rhmap/octree/occupancy_octree_base_members.hpp"
