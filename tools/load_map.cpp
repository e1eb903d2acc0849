// SPDX-License-Identifier: BSD-3-Clause
#include "load_map.hpp"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <stdexcept>

#include "arguments.hpp"

namespace rhmap::tools {
namespace {

/// Fills `map.format` and `map.header`; files from before OctoMap 1.0 have no text header and leave them alone.
void loadHeader(const std::string& path, LoadedMap& map) try {
  std::ifstream in(path, std::ios::binary);
  const std::optional<MapFormat> format = readMagicLine(in);
  if (!format) return;
  map.format = *format;
  map.header = readMapHeader(in);
  if (map.format == MapFormat::kFull && map.header.id != "OcTree")
    throw std::runtime_error(fmt::format(".ot files of the type {} cannot be read; one of: OcTree", map.header.id));
} catch (const std::runtime_error& reason) {
  throw std::runtime_error(path + ": " + reason.what());
}

}  // namespace

LoadedMap loadMap(const std::string& path) {
  requireExists(path);
  LoadedMap map;
  loadHeader(path, map);
  std::unique_ptr<AbstractOcTree> tree = readMapFile(path);
  map.tree.reset(dynamic_cast<OcTree*>(tree.get()));
  if (!map.tree) throw std::runtime_error(path + ": not the map of an OcTree");
  tree.release();
  if (map.header.id.empty())
    map.header = {.id = map.tree->getTreeType(),
                  .size = static_cast<unsigned>(map.tree->size()),
                  .resolution = map.tree->getResolution()};
  return map;
}

}  // namespace rhmap::tools
