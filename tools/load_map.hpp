// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "rhmap/octree/color_octree.hpp"
#include "rhmap/octree/map_file.hpp"
#include "rhmap/octree/octree.hpp"
#include "rhmap/octree/stamped_octree.hpp"

namespace rhmap::tools {

/// A map and what its file said of it.
struct LoadedMap {
  MapFormat format = MapFormat::kBinary;
  MapHeader header;
  std::unique_ptr<AbstractOccupancyOcTree> tree;  ///< an OcTree, ColorOcTree or OcTreeStamped
};

/// Reads .bt (whatever its id) and .ot (of a tree with occupancy); which of them it is, the first line says and not the
/// extension. Throws std::runtime_error that names the file and says what is wrong.
LoadedMap loadMap(const std::string& path);

/// Calls `visit` with the tree as what it is.
template <class F>
auto visitTree(const AbstractOccupancyOcTree& tree, F&& visit) {
  if (const auto* color = dynamic_cast<const ColorOcTree*>(&tree)) return visit(*color);
  if (const auto* stamped = dynamic_cast<const OcTreeStamped*>(&tree)) return visit(*stamped);
  return visit(dynamic_cast<const OcTree&>(tree));
}

}  // namespace rhmap::tools
