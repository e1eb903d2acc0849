// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/Pointcloud.h>

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <span>
#include <string_view>

namespace rhmap {

/// What every mapper starts from.
struct MapperConfig {
  double resolution = 0.1;  ///< edge of the smallest cube [m]
  int num_threads = 1;      ///< threads of one insertion; a mapper that has no threads ignores it
};

/// A map that grows scan by scan: rhmap and OctoMap behind one interface, so that both are fed and measured alike.
class Mapper {
 public:
  virtual ~Mapper() = default;

  /// The kind that makeMapper() made it from.
  virtual std::string_view name() const = 0;

  /// Marks the cells that the rays cross as free and those that they end in as occupied (OctoMap's insertPointCloud,
  /// eager). Points and origin in the world frame [m]; rays are cut at `max_range` [m], below 0 there is no limit.
  virtual void insert(const octomap::Pointcloud& world_points, const octomap::point3d& sensor_origin,
                      double max_range) = 0;

  /// Nodes of the tree, inner ones and the root included.
  virtual std::size_t nodeCount() const = 0;

  /// Nodes without children; counted by a walk over the tree.
  virtual std::size_t leafCount() const = 0;

  /// What the tree itself says it occupies [bytes]; OctoMap's figure leaves malloc's share out (see ResidentMemory).
  virtual std::size_t memoryUsage() const = 0;

  /// Writes the map with all its log-odds (.ot). Like the other two it leaves failure to the state of the stream.
  virtual void write(std::ostream& out) const = 0;

  /// Writes two bits a node (.bt) for the tree as it is.
  virtual void writeBinaryConst(std::ostream& out) const = 0;

  /// Writes the .bt that OctoMap's writeBinary() gives, most likely states and pruned; works on a copy of the map.
  virtual void writeBinary(std::ostream& out) const = 0;
};

/// The kinds of mapper that makeMapper() knows.
std::span<const std::string_view> mapperKinds();

/// An empty map of that kind; throws std::invalid_argument that names the right ones, or the wrong field of the config.
std::unique_ptr<Mapper> makeMapper(std::string_view kind, const MapperConfig& config = {});

}  // namespace rhmap
