// SPDX-License-Identifier: BSD-3-Clause
#include "region_map.hpp"

#include <algorithm>
#include <cstdlib>

namespace rhmap {

void Octant::remove(std::uint64_t cubes) {
  occupied &= ~cubes;
  ground &= ~cubes;
  safe &= ~cubes;
  doubted &= ~cubes;
  firm &= ~cubes;
  forEachBit(cubes, [this](int bit) {
    const auto i = static_cast<std::size_t>(bit);
    hits[i] = 0;
    misses[i] = 0;
  });
}

RegionMap::~RegionMap() {
  for (Column* column : in_order_) delete column;
}

Column& RegionMap::getOrCreate(key_type x, key_type y) {
  if (Column* known = find(x, y)) return *known;
  auto* column = new Column{.x = x, .y = y, .regions = {}};
  columns_.insert(nameOf(x, y), column);
  in_order_.push_back(column);
  for (const Cubes& cubes : read_(static_cast<key_type>(x << bits_), static_cast<key_type>(y << bits_), size())) {
    Region& region = getOrCreate(*column, static_cast<key_type>(cubes.corner[2] >> bits_));
    region.octants[octantOf(cubes.corner)].occupied |= cubes.occupied;
    column->stale = true;
  }
  refreshHeights(*column);
  return *column;
}

Region& RegionMap::getOrCreate(Column& column, key_type z, std::size_t octants) {
  auto& regions = column.regions;
  const auto at = std::lower_bound(regions.begin(), regions.end(), z,
                                   [](const auto& region, key_type value) { return region->z < value; });
  if (at != regions.end() && (*at)->z == z) return **at;
  auto region = std::make_unique<Region>(Region{.x = column.x, .y = column.y, .z = z, .plane = {}, .octants = {}});
  region->octants.resize(octants);
  return **regions.insert(at, std::move(region));
}

std::pair<int, int> RegionMap::heights(const Region& region) const {
  int low = 1 << 16, high = -1;
  for (std::size_t o = 0; o < octants(); ++o) {
    const std::uint64_t bits = region.octants[o].occupied;
    if (bits == 0) continue;
    const int corner = cornerOf(region, o)[2];
    for (int z = 0; z < 4; ++z) {
      if ((bits & layerOf(z)) == 0) continue;
      low = std::min(low, corner + z);
      high = std::max(high, corner + z);
    }
  }
  return {low, high};
}

void RegionMap::refreshHeights(Column& column) const {
  if (!column.stale) return;
  column.stale = false;
  column.h_min = 0, column.h_max = -1;
  for (const auto& region : column.regions) {
    const auto [low, high] = heights(*region);
    if (low > high) continue;
    if (column.h_max < column.h_min) column.h_min = low;
    column.h_max = high;
  }
}

void RegionMap::forgetBeyond(const OcTreeKey& centre, int distance) {
  const int half = size() / 2;
  std::erase_if(in_order_, [&](Column* column) {
    const int dx = (column->x << bits_) + half - centre[0], dy = (column->y << bits_) + half - centre[1];
    if (std::max(std::abs(dx), std::abs(dy)) <= distance) return false;
    columns_.erase(nameOf(column->x, column->y));
    delete column;
    return true;
  });
}

std::size_t RegionMap::memoryUsage() const {
  std::size_t bytes = columns_.memoryUsage();
  columns_.forEach([&](const Column& column) {
    bytes += sizeof(Column) + column.regions.capacity() * sizeof(column.regions[0]) +
             column.regions.size() * (sizeof(Region) + octants() * sizeof(Octant));
  });
  return bytes;
}

}  // namespace rhmap
