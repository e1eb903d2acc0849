// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/Pointcloud.h>
#include <octomap/octomap_types.h>

#include <memory>
#include <string>
#include <utility>

#include "rhmap/octree/octree.hpp"

namespace rhmap {

/// A map with a name and a pose, under OctoMap's names: what a MapCollection is made of. Owns its map.
template <class TREETYPE>
class MapNode {
 public:
  using TreeType = TREETYPE;

  /// Without a map.
  MapNode() = default;
  /// Takes the map over. `origin`: map to collection.
  MapNode(TREETYPE* map, pose6d pose) : node_map(map), origin(std::move(pose)) {}
  /// A .bt file, whose name becomes the id; an empty map of 0.05 m cells if it cannot be read.
  MapNode(std::string filename, pose6d pose) : origin(std::move(pose)), id(std::move(filename)) { readMap(id); }
  /// Without a map or a pose: OctoMap never made this one do anything.
  MapNode(const Pointcloud& /*cloud*/, pose6d /*origin*/) {}

  /// Null if there is none.
  TREETYPE* getMap() { return node_map.get(); }
  const TREETYPE* getMap() const { return node_map.get(); }

  /// Does nothing, as in OctoMap: update getMap().
  void updateMap(const Pointcloud& /*cloud*/, point3d /*sensor_origin*/) {}

  std::string getId() const { return id; }
  void setId(std::string newid) { id = std::move(newid); }

  /// Map to collection.
  pose6d getOrigin() const { return origin; }

  /// Centres of the occupied leaves, in the frame of the collection [m].
  Pointcloud generatePointcloud() const {
    Pointcloud cloud;
    if (!node_map) return cloud;
    for (auto it = node_map->begin_leafs(), end = node_map->end_leafs(); it != end; ++it)
      if (node_map->isNodeOccupied(*it)) cloud.push_back(origin.transform(it.getCoordinate()));
    return cloud;
  }

  /// Writes a .bt file: see AbstractOccupancyOcTree::writeBinary, which this map's probabilities do not survive. False
  /// if that failed or there is no map.
  bool writeMap(std::string filename) { return node_map && node_map->writeBinary(filename); }

 protected:
  void clear() {
    node_map.reset();
    id.clear();
    origin = pose6d();
  }
  bool readMap(std::string filename) {
    node_map = std::make_unique<TREETYPE>(0.05);
    return node_map->readBinary(filename);
  }

  // OctoMap's names, which subclasses read.
  std::unique_ptr<TREETYPE> node_map;
  pose6d origin;
  std::string id;
};

}  // namespace rhmap
