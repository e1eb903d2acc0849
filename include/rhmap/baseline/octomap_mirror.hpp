// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>

#include "rhmap/baseline/octomap_nodes.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {

/// A stock octomap::OcTree that follows a map, for libraries that were compiled against OctoMap, as FCL, DART and MoveIt
/// are: sync() costs time in proportion to what has changed in the map since the last time, not to the map.
///
///     auto mirror = std::make_shared<rhmap::OctomapMirror>(map);
///     fcl::OcTreed obstacles(mirror);
///     map.insertPointCloud(points, sensor_origin);
///     mirror->sync();  // now the mirror, and what looks at it, is up to date
///
/// After sync() it is what OctoMap itself would hold (see toOctomap()), and nodes that are still in the map have kept
/// their addresses. Values written through node pointers or iterators (`map.search(key)->setLogOdds(...)`) are not
/// noticed: call syncAll() then. updateInnerOccupancy() and toMaxLikelihood() count as a change of everything.
///
/// The mirror is for reading: what is written into it stays only until that part of the map changes. Any number of
/// mirrors may follow a map. If the map goes first, the mirror stays as it was after the last sync().
///
/// Threads: sync() is a call that reads the map and one that writes the mirror.
template <class NODE>
class BasicOctomapMirror : public octomap::OcTree {
  using Map = rhmap::OccupancyOcTreeBase<NODE>;  // without rhmap:: it would be OctoMap's, which is a base class here

 public:
  /// Up to date from the start.
  explicit BasicOctomapMirror(const Map& map)
      : octomap::OcTree(map.getResolution()), map_(&map), changes_(map.store().observe()) {
    sync();
  }
  BasicOctomapMirror(const BasicOctomapMirror&) = delete;
  BasicOctomapMirror& operator=(const BasicOctomapMirror&) = delete;

  /// False once the map is gone.
  bool connected() const { return changes_.connected(); }

  /// Brings the mirror up to date, resolution and sensor model included. Returns how many blocks (pieces of up to 8 x 8
  /// x 8 cells, or of three levels above cells) were rewritten; 0 if nothing has changed or the map is gone.
  std::size_t sync() {
    if (!connected()) return 0;
    octomap_nodes::copyModel(*map_, *this);
    const BlockChanges changes = map_->store().takeChanges(changes_);
    // If memory runs out on the way, the changes are lost: then the next call looks at everything.
    const bool all = std::exchange(unfinished_, true) || changes.all;
    const auto partly = all ? std::nullopt : octomap_nodes::writeChanged(map_->store(), changes.blocks, *this);
    const std::size_t blocks = partly ? *partly : octomap_nodes::writeAll(map_->store(), *this);
    unfinished_ = false;
    return blocks;
  }

  /// The same, but compares the whole map: finds what was written through node pointers.
  std::size_t syncAll() {
    unfinished_ = true;
    return sync();
  }

 private:
  const Map* map_;  // to be touched only while connected()
  BlockObserver changes_;
  bool unfinished_ = false;
};

extern template class BasicOctomapMirror<OcTreeNode>;

using OctomapMirror = BasicOctomapMirror<OcTreeNode>;

}  // namespace rhmap
