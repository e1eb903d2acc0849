// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include "rhmap/octree/node.hpp"
#include "rhmap/octree/octree_base.hpp"

namespace rhmap {

using octomap::point3d_list;

/// A node that counts.
class CountingOcTreeNode : public OcTreeDataNode<unsigned> {
 public:
  unsigned getCount() const { return getValue(); }
  void increaseCount() { ++value; }
  void setCount(unsigned count) { setValue(count); }
};

/// Counts updates of cells; inner nodes hold the sums. octomap::CountingOcTree's names and answers. Its type id, in
/// files too, is "OcTreeBase".
class CountingOcTree : public OcTreeBase<CountingOcTreeNode> {
 public:
  /// An empty tree with cells of this edge length [m].
  CountingOcTree(double resolution) : OcTreeBase(resolution) {}  // NOLINT: implicit, as OctoMap's is

  CountingOcTree* create() const override { return new CountingOcTree(getResolution()); }

  /// Counts a cell, and all nodes above it. Null if the point [m] is outside of the tree.
  virtual CountingOcTreeNode* updateNode(const point3d& value);
  CountingOcTreeNode* updateNode(const OcTreeKey& key);

  /// Adds the centres [m] of all leaves that were counted at least `min_hits` times.
  void getCentersMinHits(point3d_list& node_centers, unsigned min_hits) const;
};

}  // namespace rhmap
