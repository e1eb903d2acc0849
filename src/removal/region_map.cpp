// SPDX-License-Identifier: BSD-3-Clause
#include "region_map.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace rhmap {
namespace {

static_assert(std::is_trivially_destructible_v<Region>);

/// What the octants are that are not known. Not to be written to: it is there for all of them.
const Octant kUnknown;

/// Of a region with so many octants.
constexpr std::size_t recordBytes(std::size_t octants) {
  return (sizeof(Region) + octants * sizeof(Octant*) + alignof(Region) - 1) / alignof(Region) * alignof(Region);
}

}  // namespace

void Region::remove(std::size_t o, std::uint64_t old_cubes) {
  Octant& from = octant(o);
  from.occupied &= ~old_cubes;
  from.ground &= ~old_cubes;
  from.safe &= ~old_cubes;
  from.doubted &= ~old_cubes;
  from.firm &= ~old_cubes;
  cubes = static_cast<std::uint16_t>(cubes - popcount(old_cubes));
  column->stale = column->thinned = true;
  OctantHistory& history = historyOf(from);
  history.gone |= old_cubes;
  history.filled.reset(old_cubes);
  forEachBit(old_cubes, [&](int bit) {
    history.hits[static_cast<std::size_t>(bit)] = history.misses[static_cast<std::size_t>(bit)] = 0;
  });
}

RegionMap::RegionMap(int size, Reader read)
    : bits_(std::countr_zero(static_cast<unsigned>(size))),
      read_(std::move(read)),
      region_pool_(pieces_, {.bytes = recordBytes(octants())}) {}

RegionMap::~RegionMap() {
  for (const Place& place : in_order_) place.column->~Column();
}

Region* RegionMap::makeRegion(Column& column, key_type z) {
  auto* region = new (region_pool_.allocate()) Region{.x = column.x, .y = column.y, .z = z, .column = &column};
  std::uninitialized_fill_n(region->places(), octants(), const_cast<Octant*>(&kUnknown));
  return region;
}

void RegionMap::makeOctant(Region& region, std::size_t o) {
  region.places()[o] = octant_pool_.allocate();
  region.known_octants |= std::uint64_t{1} << o;
}

Column& RegionMap::getOrCreate(key_type x, key_type y) {
  if (Column* known = find(x, y)) return *known;
  auto* column = new (column_pool_.allocate()) Column{.x = x, .y = y, .regions = {}, .ground = {}};
  columns_.insert(nameOf(x, y), column);
  in_order_.push_back({x, y, column});
  for (std::size_t i = 0; i < kAround.size(); ++i) {
    column->around[i] = find(x + kAround[i].x, y + kAround[i].y);
    if (column->around[i] != nullptr) column->around[i]->around[i ^ 1] = column;
  }
  for (const auto& [corner, cubes] :
       read_(static_cast<key_type>(x << bits_), static_cast<key_type>(y << bits_), size())) {
    Region& region = getOrCreate(*column, static_cast<key_type>(corner[2] >> bits_));
    getOrCreate(region, octantOf(corner));
    region.add(octantOf(corner), cubes);
    column->stale = true;
  }
  refreshHeights(*column);
  return *column;
}

Region& RegionMap::getOrCreate(Column& column, key_type z) {
  auto& regions = column.regions;
  const auto at = std::lower_bound(regions.begin(), regions.end(), z,
                                   [](const Region* region, key_type value) { return region->z < value; });
  if (at != regions.end() && (*at)->z == z) return **at;
  Region* region = *regions.insert(at, makeRegion(column, z));
  regions_.insert(nameOf(column.x, column.y, z), region);
  return *region;
}

std::pair<int, int> RegionMap::heights(const Region& region) const {
  int low = 1 << 16, high = -1;
  forEachBit(region.known_octants, [&](int number) {
    const auto o = static_cast<std::size_t>(number);
    const std::uint64_t cubes = region.octant(o).occupied;
    if (cubes == 0) return;
    const int corner = cornerOf(region, o)[2];
    const auto [bottom, top] = layersOf(cubes);
    low = std::min(low, corner + bottom);
    high = std::max(high, corner + top);
  });
  return {low, high};
}

void RegionMap::refreshHeights(Column& column) const {
  if (!column.stale) return;
  column.stale = false;
  column.h_min = Column().h_min, column.h_max = Column().h_max;
  for (const Region* region : column.regions) {
    const auto [low, high] = heights(*region);
    if (low <= high) column.raise(low, high);
  }
}

void RegionMap::forgetBeyond(const OcTreeKey& centre, int distance) {
  const int half = size() / 2;
  std::erase_if(in_order_, [&](const Place& place) {
    Column* column = place.column;
    const int dx = (column->x << bits_) + half - centre[0], dy = (column->y << bits_) + half - centre[1];
    if (std::max(std::abs(dx), std::abs(dy)) <= distance) return false;
    columns_.erase(nameOf(column->x, column->y));
    for (std::size_t i = 0; i < kAround.size(); ++i)
      if (column->around[i] != nullptr) column->around[i]->around[i ^ 1] = nullptr;
    for (Region* region : column->regions) {
      regions_.erase(nameOf(region->x, region->y, region->z));
      forEachBit(region->known_octants,
                 [&](int o) { octant_pool_.release(&region->octant(static_cast<std::size_t>(o))); });
      region_pool_.release(region);
    }
    column->~Column();
    column_pool_.release(column);
    return true;
  });
}

std::size_t RegionMap::memoryUsage() const {
  std::size_t bytes = columns_.memoryUsage() + regions_.memoryUsage() + column_pool_.memoryUsage() +
                      region_pool_.memoryUsage() + octant_pool_.memoryUsage();
  for (const Place& place : in_order_) bytes += place.column->regions.capacity() * sizeof(place.column->regions[0]);
  return bytes;
}

}  // namespace rhmap
