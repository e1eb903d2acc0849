// SPDX-License-Identifier: BSD-3-Clause
#include "load_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

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
  constexpr std::array<std::string_view, 3> kTypes{"OcTree", "ColorOcTree", "OcTreeStamped"};
  if (map.format == MapFormat::kFull && std::find(kTypes.begin(), kTypes.end(), map.header.id) == kTypes.end())
    throw std::runtime_error(
        fmt::format(".ot files of the type {} cannot be read; one of: {}", map.header.id, fmt::join(kTypes, ", ")));
} catch (const std::runtime_error& reason) {
  throw std::runtime_error(path + ": " + reason.what());
}

}  // namespace

LoadedMap loadMap(const std::string& path) {
  requireExists(path);
  LoadedMap map;
  loadHeader(path, map);
  std::unique_ptr<AbstractOcTree> tree = readMapFile(path);
  map.tree.reset(dynamic_cast<AbstractOccupancyOcTree*>(tree.get()));
  if (!map.tree) throw std::runtime_error(path + ": not a map of occupancy");
  tree.release();
  if (map.header.id.empty())
    map.header = {.id = map.tree->getTreeType(),
                  .size = static_cast<unsigned>(map.tree->size()),
                  .resolution = map.tree->getResolution()};
  return map;
}

}  // namespace rhmap::tools
