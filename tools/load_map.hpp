// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "rhmap/octree/map_file.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap::tools {

/// A map and what its file said of it.
struct LoadedMap {
  MapFormat format = MapFormat::kBinary;
  MapHeader header;
  std::unique_ptr<OcTree> tree;
};

/// Reads .bt (whatever its id) and .ot (of an OcTree); which of them it is, the first line says and not the extension.
/// Throws std::runtime_error that names the file and says what is wrong.
LoadedMap loadMap(const std::string& path);

}  // namespace rhmap::tools
