// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "rhmap/baseline/octomap_nodes.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {

/// A copy of a map as a stock octomap::OcTree, for libraries that were compiled against OctoMap (FCL, DART, MoveIt
/// ...).
///
/// It is what OctoMap itself would hold: the same nodes, pruned or not, the same values, inner and outdated ones too,
/// to the bit, the resolution and the sensor model. Box limits and detected changes are not copied. Of nodes with more
/// than occupancy (colours, times) the occupancy is. A copy that follows the map: see OctomapMirror.
template <class NODE>
std::unique_ptr<octomap::OcTree> toOctomap(const OccupancyOcTreeBase<NODE>& map) {
  auto tree = std::make_unique<octomap::OcTree>(map.getResolution());
  octomap_nodes::copyModel(map, *tree);
  octomap_nodes::writeAll(map.store(), *tree);
  return tree;
}

/// The way back, as exact. Throws std::invalid_argument if the tree has children below depth 16, which are no cells.
OcTree fromOctomap(const octomap::OcTree& tree);

}  // namespace rhmap
