// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>
#include <string>

#include "rhmap/octree/occupancy_octree_base.hpp"

namespace rhmap {

/// An occupancy node that knows when it was last updated: in seconds since 1970, by the system's clock. Two nodes are
/// equal only if their times are, too. .ot files do not hold the times, as OctoMap's do not.
class OcTreeNodeStamped : public OcTreeNode {
 public:
  bool operator==(const OcTreeNodeStamped& other) const { return value == other.value && timestamp == other.timestamp; }
  void copyData(const OcTreeNodeStamped& from) {
    OcTreeNode::copyData(from);
    timestamp = from.timestamp;
  }

  unsigned getTimestamp() const { return timestamp; }
  void setTimestamp(unsigned t) { timestamp = t; }
  void updateTimestamp() { timestamp = static_cast<unsigned>(std::time(nullptr)); }

  /// The largest log-odds of the children, now.
  void updateOccupancyChildren() {
    setLogOdds(getMaxChildLogOdds());
    updateTimestamp();
  }

 protected:
  unsigned timestamp = 0;
};

extern template class OcTreeBaseImpl<OcTreeNodeStamped, AbstractOccupancyOcTree>;
extern template class OccupancyOcTreeBase<OcTreeNodeStamped>;

/// An occupancy map with the times of updates: octomap::OcTreeStamped's names and answers.
class OcTreeStamped : public OccupancyOcTreeBase<OcTreeNodeStamped> {
 public:
  /// An empty map with cells of this edge length [m].
  OcTreeStamped(double resolution) : OccupancyOcTreeBase(resolution) {}  // NOLINT: implicit, as OctoMap's is

  OcTreeStamped* create() const override { return new OcTreeStamped(getResolution()); }
  std::string getTreeType() const override { return "OcTreeStamped"; }

  /// Time of the last update of the map [s]; 0 for an empty one.
  unsigned getLastUpdateTime() { return root != nullptr ? root->getTimestamp() : 0; }

  /// One miss, without a new time, for every occupied leaf that was last updated more than `time_thres` seconds ago.
  /// Inner nodes stay as they are.
  void degradeOutdatedNodes(unsigned time_thres);

  /// Also sets the time.
  void updateNodeLogOdds(OcTreeNodeStamped* node, const float& update) const override;
  void integrateMissNoTime(OcTreeNodeStamped* node) const;
};

}  // namespace rhmap
