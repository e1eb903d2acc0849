// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "rhmap/octree/occupancy_octree_base.hpp"

namespace rhmap {

extern template class OcTreeBaseImpl<OcTreeNode, AbstractOccupancyOcTree>;
extern template class OccupancyOcTreeBase<OcTreeNode>;

/// An occupancy map: octomap::OcTree's names and answers, with a region-wise hash map inside.
///
///     rhmap::OcTree map(0.1);                              // 10 cm cells
///     map.insertPointCloud(points, sensor_origin, 50.0);   // points in the map's frame [m]
///     if (const rhmap::OcTreeNode* node = map.search(1.0, 2.0, 0.5)) use(node->getOccupancy());
///     map.writeBinary("map.bt");
class OcTree : public OccupancyOcTreeBase<OcTreeNode> {
 public:
  /// An empty map with cells of this edge length [m].
  OcTree(double resolution) : OccupancyOcTreeBase(resolution) {}  // NOLINT: implicit, as OctoMap's is
  /// A .bt file; an empty map of 0.1 m cells if it cannot be read (use readMapFile() to learn why).
  OcTree(const std::string& filename) : OccupancyOcTreeBase(0.1) { readBinary(filename); }  // NOLINT
  OcTree(const OcTree&) = default;

  OcTree* create() const override { return new OcTree(getResolution()); }
  std::string getTreeType() const override { return "OcTree"; }
};

}  // namespace rhmap
