// SPDX-License-Identifier: BSD-3-Clause
#include "report_cells.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "html.hpp"
#include "occupied_cells.hpp"

namespace rhmap::tools {
namespace {

std::vector<OcTreeKey> keysOf(const NamedMap& named) {
  std::vector<OcTreeKey> keys;
  for (const octomap::point3d& centre : occupiedCells(named.name, *named.map))
    keys.push_back(named.map->coordToKey(centre));
  return keys;
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("zlib cannot compress a map");
  packed.resize(size);
  return packed;
}

/// Planes of bytes, which deflate well because neighbours in the tree are near each other: for each axis the low and
/// the high bytes of the keys' differences, then bits: 1 for cells that moved, 2 for cells right below another.
std::string planesOf(const std::vector<OcTreeKey>& keys, const std::array<key_type, 3>& origin, const KeySet& moving) {
  std::string planes;
  planes.reserve(7 * keys.size());
  for (unsigned axis = 0; axis < 3; ++axis) {
    std::string low, high;
    int before = 0;
    for (const OcTreeKey& key : keys) {
      const int value = key[axis] - origin[axis], difference = value - before;
      // Signed as 0, -1, 1, -2 ...; in 16 bits, in which the reader adds as well.
      const int step = static_cast<std::int16_t>(difference);
      const auto zigzag = static_cast<std::uint16_t>(step << 1 ^ step >> 31);
      low.push_back(static_cast<char>(zigzag & 0xff));
      high.push_back(static_cast<char>(zigzag >> 8));
      before = value;
    }
    planes += low + high;
  }
  KeySet all;
  for (const OcTreeKey& key : keys) all.insert(key);
  for (const OcTreeKey& key : keys) {
    const bool covered = all.contains(OcTreeKey(key[0], key[1], static_cast<key_type>(key[2] + 1)));
    planes.push_back(static_cast<char>((moving.contains(key) ? 1 : 0) | (covered ? 2 : 0)));
  }
  return planes;
}

}  // namespace

std::string cellsJson(std::span<const NamedMap> maps, const KeySet& moving) {
  std::vector<std::vector<OcTreeKey>> keys;
  std::array<key_type, 3> min{0xffff, 0xffff, 0xffff}, max{0, 0, 0};
  std::array<std::vector<key_type>, 3> places;  // of all cells, for where to look
  for (const NamedMap& map : maps) {
    keys.push_back(keysOf(map));
    for (const OcTreeKey& key : keys.back())
      for (unsigned axis = 0; axis < 3; ++axis) {
        min[axis] = std::min(min[axis], key[axis]);
        max[axis] = std::max(max[axis], key[axis]);
        places[axis].push_back(key[axis]);
      }
  }
  const auto quantile = [&](unsigned axis, double q) {
    auto& values = places[axis];
    if (values.empty()) return 0;
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(q * double(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth - min[axis];
  };

  nlohmann::ordered_json json;
  json["centre"] = {quantile(0, 0.5), quantile(1, 0.5), quantile(2, 0.5)};
  json["size"] = nlohmann::ordered_json::array();
  for (unsigned axis = 0; axis < 3; ++axis)
    json["size"].push_back(std::max(10, quantile(axis, 0.98) - quantile(axis, 0.02)));
  json["heights"] = {quantile(2, 0.02), std::max(quantile(2, 0.98), quantile(2, 0.02) + 1)};
  json["maps"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < maps.size(); ++i)
    json["maps"].push_back({{"name", maps[i].name},
                            {"count", keys[i].size()},
                            {"cells", base64(deflated(planesOf(keys[i], min, moving)))}});
  return json.dump();
}

}  // namespace rhmap::tools
