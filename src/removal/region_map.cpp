// SPDX-License-Identifier: BSD-3-Clause
#include "region_map.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace rhmap {
namespace {

static_assert(std::is_trivially_destructible_v<Region> && std::is_trivially_destructible_v<Octant>);

/// So many bytes, up to where octants are aligned.
constexpr std::size_t aligned(std::size_t bytes) {
  return (bytes + alignof(Octant) - 1) / alignof(Octant) * alignof(Octant);
}

constexpr std::size_t kRegionBytes = aligned(sizeof(Region));

/// Of a region with so many octants and all that is kept of them. An odd number of lines of the cache: at a distance of
/// a power of two, the first lines of all regions would share a few places in it.
constexpr std::size_t recordBytes(std::size_t octants) {
  const std::size_t bytes = octants * (sizeof(Octant) + sizeof(OctantCounts) + sizeof(OctantPast));
  return (kRegionBytes + aligned(bytes)) | alignof(Octant);
}

}  // namespace

void Region::remove(std::size_t octant, std::uint64_t old_cubes) {
  Octant& from = octants[octant];
  from.occupied &= ~old_cubes;
  from.ground &= ~old_cubes;
  from.safe &= ~old_cubes;
  from.doubted &= ~old_cubes;
  from.firm &= ~old_cubes;
  cubes = static_cast<std::uint16_t>(cubes - std::popcount(old_cubes));
  column->stale = column->thinned = true;
  OctantPast& of = past[octant];
  of.gone |= old_cubes;
  of.filled.reset(old_cubes);
  forEachBit(old_cubes, [&](int bit) { counts[octant][static_cast<std::size_t>(bit)] = {}; });
}

RegionMap::RegionMap(int size, Reader read)
    : bits_(std::countr_zero(static_cast<unsigned>(size))), read_(std::move(read)), pool_(recordBytes(octants())) {}

RegionMap::~RegionMap() {
  for (Column* column : in_order_) delete column;
}

/// One piece of memory: the region, its octants, their counts, their past.
Region* RegionMap::makeRegion(Column& column, key_type z) {
  auto* memory = static_cast<std::byte*>(pool_.allocate());
  auto* first_octant = reinterpret_cast<Octant*>(memory + kRegionBytes);
  std::uninitialized_value_construct_n(first_octant, octants());
  auto* first_counts = reinterpret_cast<OctantCounts*>(first_octant + octants());
  std::uninitialized_value_construct_n(first_counts, octants());
  auto* first_past = reinterpret_cast<OctantPast*>(first_counts + octants());
  std::uninitialized_value_construct_n(first_past, octants());
  return new (memory) Region{.x = column.x,
                             .y = column.y,
                             .z = z,
                             .column = &column,
                             .octants = {first_octant, octants()},
                             .counts = {first_counts, octants()},
                             .past = {first_past, octants()}};
}

Column& RegionMap::getOrCreate(key_type x, key_type y) {
  if (Column* known = find(x, y)) return *known;
  auto* column = new Column{.x = x, .y = y, .regions = {}, .ground = {}};
  columns_.insert(nameOf(x, y), column);
  in_order_.push_back(column);
  for (const auto& [corner, cubes] :
       read_(static_cast<key_type>(x << bits_), static_cast<key_type>(y << bits_), size())) {
    Region& region = getOrCreate(*column, static_cast<key_type>(corner[2] >> bits_));
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
  for (std::size_t o = 0; o < octants(); ++o) {
    const std::uint64_t bits = region.octants[o].occupied;
    if (bits == 0) continue;
    const int corner = cornerOf(region, o)[2];
    const auto [bottom, top] = layersOf(bits);
    low = std::min(low, corner + bottom);
    high = std::max(high, corner + top);
  }
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
  std::erase_if(in_order_, [&](Column* column) {
    const int dx = (column->x << bits_) + half - centre[0], dy = (column->y << bits_) + half - centre[1];
    if (std::max(std::abs(dx), std::abs(dy)) <= distance) return false;
    columns_.erase(nameOf(column->x, column->y));
    for (Region* region : column->regions) {
      regions_.erase(nameOf(region->x, region->y, region->z));
      pool_.release(region);
    }
    delete column;
    return true;
  });
}

std::size_t RegionMap::memoryUsage() const {
  std::size_t bytes = columns_.memoryUsage() + regions_.memoryUsage() + pool_.memoryUsage();
  columns_.forEach(
      [&](const Column& column) { bytes += sizeof(Column) + column.regions.capacity() * sizeof(column.regions[0]); });
  return bytes;
}

}  // namespace rhmap
