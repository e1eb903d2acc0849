// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "cell_counters.hpp"
#include "rhmap/core/block_index.hpp"
#include "rhmap/core/key.hpp"
#include "rhmap/core/prefetch.hpp"
#include "rhmap/core/record_pool.hpp"

namespace rhmap {

template <class F>
void forEachBit(std::uint64_t bits, F&& visit) {
  for (; bits != 0; bits &= bits - 1) visit(std::countr_zero(bits));
}

/// 4 x 4 x 4 cubes, bits in Morton order: what lies under one depth-14 node of the tree. One line of the cache.
struct alignas(64) Octant {
  std::uint64_t occupied = 0;  ///< cubes that are in the map
  std::uint64_t ground = 0;    ///< of these, cubes of the ground
  std::uint64_t safe = 0;      ///< of these, cubes so near to its plane that they stay whatever happens
  std::uint64_t doubted = 0;   ///< of these, cubes that have been seen through since their last hit
  std::uint64_t firm = 0;      ///< of these, cubes that many scans have hit, or have seen something at
  // Of scan Region::scan:
  std::uint64_t hit = 0;       ///< cubes that it has hit
  std::uint64_t fresh = 0;     ///< of these, cubes that were not in the map before
  std::uint64_t appeared = 0;  ///< of these, cubes that past scans have seen through
};

/// Some cubes of an octant, which is named by its lowest cube.
struct CubesAt {
  OcTreeKey corner;
  std::uint64_t cubes;
};

/// What is counted of a cube, up to 255. Apart from the masks, which are read far more often.
struct CubeCounts {
  std::uint8_t hits = 0;    ///< scans that have hit it
  std::uint8_t misses = 0;  ///< scans that have seen through it since its last hit
};
using OctantCounts = std::array<CubeCounts, 64>;

/// What else is remembered of an octant's cubes.
struct OctantPast {
  Counters<3> filled;                   ///< looks that have seen something at a cube's place
  std::uint64_t gone = 0;               ///< cubes that have been taken out of the map; some may be there again
  std::uint32_t first = 0;              ///< the first scan that has hit the octant; 0: none
  std::array<std::uint8_t, 8> scans{};  ///< scans that have hit each of its cells of the void, up to 255
};

/// One more, up to 255.
inline void countUp(std::uint8_t& counter) { counter = static_cast<std::uint8_t>(counter + (counter < 255)); }

/// n . I = d: a plane of the ground in cubes, from the lowest cube of its region.
struct Plane {
  std::array<float, 3> n{0, 0, 1};
  float d = 0;

  float above(float x, float y, float z) const { return n[0] * x + n[1] * y + n[2] * z - d; }
};

struct Column;

/// Whose turn it is goes over the columns from scan to scan, so that all scans have the same to do.
inline std::uint32_t turnOf(key_type x, key_type y, std::uint32_t scan) { return x + y + scan; }

/// M_{I_r}: a region, a cube of 4, 8 or 16 cubes an axis.
struct Region {
  key_type x = 0, y = 0, z = 0;  ///< I_r >> bits
  std::uint32_t scan = 0;        ///< the last scan that hit it
  std::uint16_t cubes = 0;       ///< in the map
  bool doubtful = false;         ///< there may be cubes that are doubted
  std::uint64_t hit_octants = 0;    ///< those that the scan has hit
  std::uint64_t loose_octants = 0;  ///< those that may have cubes that are not safe
  Column* column = nullptr;         ///< the one that it stands in
  std::span<Octant> octants;        ///< in Morton order
  std::span<OctantCounts> counts;
  std::span<OctantPast> past;

  /// Whether there are cubes that were not in the map before the scan that was the last to hit it.
  bool hasFresh() const {
    bool fresh = false;
    forEachBit(hit_octants, [&](int o) { fresh = fresh || octants[static_cast<std::size_t>(o)].fresh != 0; });
    return fresh;
  }

  /// Puts cubes of an octant that are not there yet into the map.
  void add(std::size_t octant, std::uint64_t new_cubes) {
    octants[octant].occupied |= new_cubes;
    loose_octants |= std::uint64_t{new_cubes != 0} << octant;
    cubes = static_cast<std::uint16_t>(cubes + std::popcount(new_cubes));
  }
  /// Notes the doubtful cubes of an octant, if there are any.
  void noteDoubts(std::size_t octant);
  /// Takes cubes of an octant that are there out of the map.
  void remove(std::size_t octant, std::uint64_t old_cubes);
};

/// The regions above each other at one O_r, and H{max,min}(O_r). One line of the cache but for the list: who looks at
/// the ground around looks at many.
struct alignas(64) Column {
  key_type x = 0, y = 0;              ///< O_r >> bits
  key_type h_min = 0xffff, h_max = 0; ///< keys of the lowest and the highest cube; none: max < min
  bool doubtful = false;              ///< so may one of its regions be
  bool stale = false;                 ///< cubes were removed since h_min and h_max were computed
  bool thinned = false;               ///< cubes were removed
  bool has_ground = false;            ///< `ground` is the ground's, in its base
  key_type base_z = 0;                ///< that of `base`
  std::uint16_t at_fit = 0;           ///< cubes of the base at the last try to fit a plane
  Region* base = nullptr;             ///< where R-GPE looks for ground: the lowest region with a cube
  std::vector<Region*> regions;       ///< by z, ascending
  Plane ground;

  /// With cubes from one height to another.
  void raise(int low, int high) {
    h_min = static_cast<key_type>(std::min<int>(h_min, low));
    h_max = static_cast<key_type>(std::max<int>(h_max, high));
  }
  /// The lowest region that holds a cube; null if none does.
  Region* lowest() const {
    for (Region* region : regions)
      if (region->cubes > 0) return region;
    return nullptr;
  }
};

/// Visits the columns columnAt(0) ... columnAt(n - 1) that are `due`. They lie all over the memory: asks for them,
/// their lists and their regions some time before they are needed.
template <class ColumnAt, class Due, class F>
void visitColumns(std::size_t n, ColumnAt&& columnAt, Due&& due, F&& visit) {
  constexpr std::size_t kAhead = 4;
  const auto ahead = [&](std::size_t i) -> const Column* { return i < n && due(*columnAt(i)) ? columnAt(i) : nullptr; };
  for (std::size_t i = 0; i < n; ++i) {
    if (i + 3 * kAhead < n) __builtin_prefetch(columnAt(i + 3 * kAhead));
    if (const Column* column = ahead(i + 2 * kAhead)) __builtin_prefetch(column->regions.data());
    if (const Column* column = ahead(i + kAhead))
      for (const Region* region : column->regions) prefetchWhole(region);
    if (due(*columnAt(i))) visit(*columnAt(i));
  }
}

inline void Region::noteDoubts(std::size_t octant) {
  if (octants[octant].doubted != 0) doubtful = column->doubtful = true;
}

/// Bits 0 to 3 of a key, three places apart.
inline constexpr std::array<std::uint16_t, 16> kSpread = [] {
  std::array<std::uint16_t, 16> spread{};
  for (unsigned i = 0; i < 16; ++i) spread[i] = static_cast<std::uint16_t>(spread3(i) | (i & 8) << 6);
  return spread;
}();

/// Morton index of a cube among 16 x 16 x 16.
inline std::size_t mortonOf(const OcTreeKey& cube) {
  return static_cast<std::size_t>(kSpread[cube[0] & 15] | kSpread[cube[1] & 15] << 1 | kSpread[cube[2] & 15] << 2);
}

/// What the removal knows of the map around the sensor: RH-Map's attributes of regions and cubes (Sec. III-B), in a
/// hash map of columns. A cache: what is forgotten is read again from the tree when a scan comes by.
class RegionMap {
 public:
  /// Reads a column of the tree: all octants with occupied cubes between (x, y) and (x + size, y + size), in keys.
  using Reader = std::function<std::vector<CubesAt>(key_type x, key_type y, int size)>;

  /// Regions of `size` cubes: 4, 8 or 16.
  RegionMap(int size, Reader read);
  RegionMap(const RegionMap&) = delete;
  RegionMap& operator=(const RegionMap&) = delete;
  ~RegionMap();

  int bits() const { return bits_; }
  int size() const { return 1 << bits_; }
  /// Octants of a region.
  std::size_t octants() const { return std::size_t{1} << 3 * (bits_ - 2); }

  Column* find(int x, int y) const { return columns_.find(nameOf(x, y)); }
  Region* find(int x, int y, int z) const { return regions_.find(nameOf(x, y, z)); }
  Column& getOrCreate(key_type x, key_type y);
  Region& getOrCreate(Column& column, key_type z);
  /// The region of a cube.
  Region& getOrCreate(const OcTreeKey& cube) {
    const auto part = [&](unsigned axis) { return static_cast<key_type>(cube[axis] >> bits_); };
    return getOrCreate(getOrCreate(part(0), part(1)), part(2));
  }
  /// Regions by one number each, for who looks up many: what `find` will read can be asked for before.
  std::uint64_t nameOf(const OcTreeKey& cube) const {
    return nameOf(cube[0] >> bits_, cube[1] >> bits_, cube[2] >> bits_);
  }
  Region* find(std::uint64_t name) const { return regions_.find(name); }
  [[gnu::always_inline]] void prefetch(std::uint64_t name) const { regions_.prefetch(name); }

  /// The region that holds a cube, if it is known.
  Region* regionOf(const OcTreeKey& cube) const { return find(nameOf(cube)); }
  /// Number of the octant of a cube in its region.
  std::size_t octantOf(const OcTreeKey& cube) const { return mortonOf(cube) >> 6 & (octants() - 1); }
  /// Lowest cube of octant `o` of a region.
  OcTreeKey cornerOf(const Region& region, std::size_t o) const {
    const auto u = static_cast<unsigned>(o);
    return {static_cast<key_type>((region.x << bits_) + (gather3(u) << 2)),
            static_cast<key_type>((region.y << bits_) + (gather3(u >> 1) << 2)),
            static_cast<key_type>((region.z << bits_) + (gather3(u >> 2) << 2))};
  }

  /// Lowest and highest cube of a region, as keys; max < min if it has none.
  std::pair<int, int> heights(const Region& region) const;
  /// H{max,min} after removals.
  void refreshHeights(Column& column) const;

  /// Forgets the columns farther than this many cubes (along an axis) from a cube.
  void forgetBeyond(const OcTreeKey& centre, int distance);

  std::size_t numColumns() const { return columns_.size(); }
  std::size_t memoryUsage() const;

  /// Those that are `due`, in the order in which they became known, which is much quicker than by hash.
  template <class Due, class F>
  void forEachColumn(Due&& due, F&& visit) const {
    const auto columnAt = [this](std::size_t i) { return in_order_[i]; };
    visitColumns(in_order_.size(), columnAt, due, visit);
  }
  template <class F>
  void forEachColumn(F&& visit) const {
    forEachColumn([](const Column&) { return true; }, visit);
  }

 private:
  static std::uint64_t nameOf(int x, int y) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) |
           static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32;
  }
  static std::uint64_t nameOf(int x, int y, int z) {
    const auto part = [](int v) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v) & 0x1fffff); };
    return part(x) | part(y) << 21 | part(z) << 42;
  }

  Region* makeRegion(Column& column, key_type z);

  int bits_;
  Reader read_;
  RecordPool pool_;  // regions, each with its octants and their counts
  BlockIndex<Column> columns_;
  BlockIndex<Region> regions_;
  std::vector<Column*> in_order_;  // the same
};

/// Bit of a cube in its octant.
inline int bitOf(const OcTreeKey& cube) { return static_cast<int>(mortonOf(cube) & 63); }
inline constexpr std::uint64_t maskOf(int bit) { return std::uint64_t{1} << bit; }
/// The cube of a bit, from the octant's lowest cube.
inline OcTreeKey cubeOf(const OcTreeKey& corner, int bit) {
  const auto b = static_cast<unsigned>(bit);
  const auto along = [b](unsigned axis) { return (b >> axis & 1) | (b >> (axis + 2) & 2); };
  return {static_cast<key_type>(corner[0] + along(0)), static_cast<key_type>(corner[1] + along(1)),
          static_cast<key_type>(corner[2] + along(2))};
}
/// The cubes of an octant with this z in it (0 ... 3).
inline constexpr std::uint64_t layerOf(int z) {
  return std::uint64_t{0x0f0f0f0f} << (4 * (z & 1)) << (32 * (z >> 1 & 1));
}
/// The lowest and the highest z of cubes of an octant of which there is one at least.
inline std::pair<int, int> layersOf(std::uint64_t cubes) {
  int low = 0, high = 3;
  while ((cubes & layerOf(low)) == 0) ++low;
  while ((cubes & layerOf(high)) == 0) --high;
  return {low, high};
}

}  // namespace rhmap
