// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "rhmap/core/failure.hpp"
#include "rhmap/octree/map_collection_file.hpp"
#include "rhmap/octree/map_node.hpp"

namespace rhmap {

/// The frames of a collection and of a map in it; out of line, so that a consumer's -mfma cannot change them.
namespace map_frame {
point3d pointInMap(const pose6d& map_pose, const point3d& p);
point3d directionInMap(const pose6d& map_pose, const point3d& direction);
double distance(const point3d& a, const point3d& b);
}  // namespace map_frame

/// Writes points [m] as a VRML 2.0 PointSet; throws std::runtime_error that names file and reason.
void writeVrml(const std::filesystem::path& file, const Pointcloud& points);

/// Reads a collection file and its maps, all or none. Throws std::runtime_error that names the file and says what is
/// wrong.
template <class MAPNODE>
std::vector<std::unique_ptr<MAPNODE>> readMapCollection(const std::filesystem::path& file) {
  std::vector<std::unique_ptr<MAPNODE>> nodes;
  for (const MapCollectionEntry& entry : readMapCollectionFile(file)) {
    auto map = std::make_unique<typename MAPNODE::TreeType>(0.05);
    if (!map->readBinary(entry.map_file.string()))
      failOnFile(file, "names a map that cannot be read: " + entry.map_file.string());
    auto node = std::make_unique<MAPNODE>(map.get(), entry.pose);
    map.release();
    node->setId(entry.id);
    nodes.push_back(std::move(node));
  }
  return nodes;
}

/// Several maps, each with a pose, asked as one: under OctoMap's names and with OctoMap's answers. Points and
/// directions in the frame of the collection [m].
///
/// The nodes are not the collection's, as in OctoMap: it never deletes one, be it added or read from a file, and code
/// that was written for OctoMap keeps their maps when the collection is gone. Delete them when done with them:
/// `for (auto* node : collection) delete node;`.
template <class MAPNODE>
class MapCollection {
 public:
  using iterator = typename std::vector<MAPNODE*>::iterator;
  using const_iterator = typename std::vector<MAPNODE*>::const_iterator;

  MapCollection() = default;
  /// A collection file with its maps; empty if one of them cannot be read (use readMapCollection() to learn why).
  MapCollection(std::string filename) { read(filename); }  // NOLINT: implicit, as OctoMap's is

  void addNode(MAPNODE* node) { nodes.push_back(node); }
  /// Null: OctoMap never made it do anything.
  MAPNODE* addNode(const Pointcloud& /*cloud*/, point3d /*sensor_origin*/) { return nullptr; }
  /// Takes a node out, without deleting it; false if it is not in. (OctoMap's does nothing.)
  bool removeNode(const MAPNODE* n) {
    const auto it = std::find(nodes.begin(), nodes.end(), n);
    if (it == nodes.end()) return false;
    nodes.erase(it);
    return true;
  }

  /// The first node whose map is occupied at a point; null if there is none.
  MAPNODE* queryNode(const point3d& p) const {
    for (MAPNODE* node : nodes)
      if (const auto* found = search(node, p); found != nullptr && node->getMap()->isNodeOccupied(found)) return node;
    return nullptr;
  }
  /// The first node with this id; null if there is none.
  MAPNODE* queryNode(std::string id) const {
    for (MAPNODE* node : nodes)
      if (node != nullptr && node->getId() == id) return node;
    return nullptr;
  }

  /// In any of the maps.
  bool isOccupied(const point3d& p) const { return queryNode(p) != nullptr; }
  bool isOccupied(float x, float y, float z) const { return isOccupied(point3d(x, y, z)); }

  /// The highest probability that a map has at a point; 0.5 where none knows it.
  double getOccupancy(const point3d& p) const {
    double highest = 0.0;
    bool known = false;
    for (MAPNODE* node : nodes)
      if (const auto* found = search(node, p)) {
        highest = std::max(highest, found->getOccupancy());
        known = true;
      }
    return known ? highest : 0.5;
  }

  /// Follows a ray in each map (see OccupancyOcTreeBase::castRay): true if it hits something in one, and `end` is the
  /// hit that is nearest to the origin. As in OctoMap, `end` is untouched if that is 1000 km away or more.
  bool castRay(const point3d& origin, const point3d& direction, point3d& end, bool ignoreUnknownCells = false,
               double maxRange = -1.0) const {
    const point3d from = origin, along = direction;  // `end` may be one of them
    bool hit = false;
    double nearest = 1e6;
    for (MAPNODE* node : nodes) {
      if (node == nullptr || node->getMap() == nullptr) continue;
      const pose6d pose = node->getOrigin();
      const point3d from_in_map = map_frame::pointInMap(pose, from);
      point3d end_in_map;
      if (!node->getMap()->castRay(from_in_map, map_frame::directionInMap(pose, along), end_in_map, ignoreUnknownCells,
                                   maxRange))
        continue;
      hit = true;
      const double distance = map_frame::distance(from_in_map, end_in_map);
      if (!(distance < nearest)) continue;
      nearest = distance;
      end = pose.transform(end_in_map);
    }
    return hit;
  }

  /// The centres of all occupied leaves as VRML, whole or not at all. False if that failed.
  bool writePointcloud(std::string filename) const {
    return succeeds([&] {
      Pointcloud points;
      for (MAPNODE* node : nodes)
        if (node != nullptr) points.push_back(node->generatePointcloud());
      writeVrml(filename, points);
    });
  }

  /// Writes the collection file, and beside it the maps as nodemap_<id>.bt, all or none. As in OctoMap the maps in
  /// memory become their maximum-likelihood estimates. False if that failed; see writeMapCollection. Nodes without a
  /// map make it fail.
  bool write(std::string filename) {
    return succeeds([&] {
      std::vector<MapCollectionEntry> entries;
      for (MAPNODE* node : nodes) {
        if (node == nullptr) failOnFile(filename, "cannot hold a null node");
        entries.push_back({node->getId(), {}, node->getOrigin()});
      }
      writeMapCollection(filename, std::move(entries), [&](std::size_t i, const std::filesystem::path& file) {
        return nodes[i]->writeMap(file.string());
      });
    });
  }

  /// Throws std::logic_error: not there in OctoMap either, where it prints so.
  void insertScan(const Pointcloud& /*scan*/, const point3d& /*sensor_origin*/, double /*maxrange*/ = -1.,
                  bool /*pruning*/ = true, bool /*lazy_eval*/ = false) {
    throw std::logic_error("MapCollection::insertScan is not implemented");
  }

  iterator begin() { return nodes.begin(); }
  iterator end() { return nodes.end(); }
  const_iterator begin() const { return nodes.begin(); }
  const_iterator end() const { return nodes.end(); }
  std::size_t size() const { return nodes.size(); }

 protected:
  /// Forgets the nodes, without deleting them.
  void clear() { nodes.clear(); }

  /// Adds what a file holds; false, and nothing added, if a part of it cannot be read.
  bool read(std::string filename) {
    return succeeds([&] {
      auto read = readMapCollection<MAPNODE>(filename);
      nodes.reserve(nodes.size() + read.size());
      for (auto& node : read) nodes.push_back(node.release());
    });
  }

  /// Throw std::logic_error: not there in OctoMap either, where they print so.
  std::vector<Pointcloud*> segment(const Pointcloud& /*scan*/) const {
    throw std::logic_error("MapCollection::segment is not implemented");
  }
  MAPNODE* associate(const Pointcloud& /*scan*/) {
    throw std::logic_error("MapCollection::associate is not implemented");
  }

  std::vector<MAPNODE*> nodes;

 private:
  /// The facade's bool for what throws.
  template <class F>
  static bool succeeds(F&& action) {
    try {
      action();
      return true;
    } catch (const std::runtime_error&) {
      return false;
    }
  }

  /// What a node's map knows at a point of the collection; null if it knows nothing or there is no map.
  static const typename MAPNODE::TreeType::NodeType* search(MAPNODE* node, const point3d& p) {
    if (node == nullptr || node->getMap() == nullptr) return nullptr;
    return node->getMap()->search(map_frame::pointInMap(node->getOrigin(), p));
  }
};

}  // namespace rhmap
