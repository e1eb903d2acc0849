// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "rhmap/core/block_index.hpp"
#include "rhmap/core/key.hpp"

namespace rhmap {

/// 4 x 4 x 4 cubes, bits in Morton order: what lies under one depth-14 node of the tree.
struct Octant {
  std::uint64_t occupied = 0;  ///< cubes that are in the map
  std::uint64_t ground = 0;    ///< of these, cubes of the ground
  std::uint64_t safe = 0;      ///< of these, cubes so near to its plane that they stay whatever happens
  std::uint64_t doubted = 0;   ///< of these, cubes that have been seen through since their last hit
  std::uint64_t firm = 0;      ///< of these, cubes that many scans have hit
  // Of scan Region::scan:
  std::uint64_t hit = 0;       ///< cubes that it has hit
  std::uint64_t fresh = 0;     ///< of these, cubes that were not in the map before
  std::uint64_t appeared = 0;  ///< of these, cubes that past scans have seen through
  // Counters up to 255:
  std::array<std::uint8_t, 64> hits{};          ///< scans that have hit the cube
  std::array<std::uint8_t, 64> misses{};        ///< scans that have seen through the cube since its last hit
  std::array<std::uint8_t, 8> hits_in_a_row{};  ///< scans that have hit a cell of free space since a ray crossed it

  /// Takes cubes out of the map.
  void remove(std::uint64_t cubes);
};

/// One more, up to 255.
inline void countUp(std::uint8_t& counter) { counter = static_cast<std::uint8_t>(counter + (counter < 255)); }

/// n . I = d: a plane of the ground in cubes, from the lowest cube of its region.
struct Plane {
  std::array<float, 3> n{0, 0, 1};
  float d = 0;

  float above(float x, float y, float z) const { return n[0] * x + n[1] * y + n[2] * z - d; }
};

/// M_{I_r}: a region, a cube of 4, 8 or 16 cubes an axis.
struct Region {
  key_type x = 0, y = 0, z = 0;  ///< I_r >> bits
  std::uint32_t scan = 0;        ///< the last scan that hit it
  std::uint16_t at_fit = 0;      ///< cubes at the last try to fit a plane
  bool fitted = false;           ///< `plane` is the ground's
  bool loose = true;             ///< there may be cubes that are not safe
  bool doubtful = false;         ///< there may be cubes that are doubted
  Plane plane;
  std::vector<Octant> octants;    ///< in Morton order
  std::uint64_t hit_octants = 0;  ///< those that the scan has hit

  /// Visits the octants that its last scan has hit: visit(number, octant).
  template <class F>
  void forEachHitOctant(F&& visit) const {
    for (std::uint64_t rest = hit_octants; rest != 0; rest &= rest - 1) {
      const auto o = static_cast<std::size_t>(std::countr_zero(rest));
      visit(o, octants[o]);
    }
  }
  template <class F>
  void forEachHitOctant(F&& visit) {
    std::as_const(*this).forEachHitOctant(
        [&](std::size_t o, const Octant& octant) { visit(o, const_cast<Octant&>(octant)); });
  }

  bool isOccupied() const {
    for (const Octant& octant : octants)
      if (octant.occupied != 0) return true;
    return false;
  }
  int countCubes() const {
    int count = 0;
    for (const Octant& octant : octants) count += std::popcount(octant.occupied);
    return count;
  }
};

/// The regions above each other at one O_r, and H{max,min}(O_r).
struct Column {
  key_type x = 0, y = 0;                         ///< O_r >> bits
  int h_min = 0, h_max = -1;                     ///< keys of the lowest and the highest cube; none: max < min
  bool stale = false;                            ///< cubes were removed since h_min and h_max were computed
  Region* base = nullptr;                        ///< where R-GPE looks for ground: the lowest region with a cube
  std::vector<std::unique_ptr<Region>> regions;  ///< by z, ascending

  Region* find(int z) const {
    for (const auto& region : regions)
      if (region->z == z) return region.get();
    return nullptr;
  }
  /// The lowest region that holds a cube; null if none does.
  Region* lowest() const {
    for (const auto& region : regions)
      if (region->isOccupied()) return region.get();
    return nullptr;
  }
};

/// What the removal knows of the map around the sensor: RH-Map's attributes of regions and cubes (Sec. III-B), in a
/// hash map of columns. A cache: what is forgotten is read again from the tree when a scan comes by.
class RegionMap {
 public:
  /// Some occupied cubes of the tree: an octant's lowest cube, and its cubes.
  struct Cubes {
    OcTreeKey corner;
    std::uint64_t occupied;
  };
  /// Reads a column of the tree: all octants with occupied cubes between (x, y) and (x + size, y + size), in keys.
  using Reader = std::function<std::vector<Cubes>(key_type x, key_type y, int size)>;

  /// Regions of `size` cubes: 4, 8 or 16.
  RegionMap(int size, Reader read) : bits_(std::countr_zero(static_cast<unsigned>(size))), read_(std::move(read)) {}
  RegionMap(const RegionMap&) = delete;
  RegionMap& operator=(const RegionMap&) = delete;
  ~RegionMap();

  int bits() const { return bits_; }
  int size() const { return 1 << bits_; }
  /// Octants of a region.
  std::size_t octants() const { return std::size_t{1} << 3 * (bits_ - 2); }

  Column* find(int x, int y) const { return columns_.find(nameOf(x, y)); }
  Region* find(int x, int y, int z) const {
    const Column* column = find(x, y);
    return column == nullptr ? nullptr : column->find(z);
  }
  Column& getOrCreate(key_type x, key_type y);
  static Region& getOrCreate(Column& column, key_type z, std::size_t octants);
  Region& getOrCreate(Column& column, key_type z) const { return getOrCreate(column, z, octants()); }

  /// The region that holds a cube, if it is known.
  Region* regionOf(const OcTreeKey& cube) const { return find(cube[0] >> bits_, cube[1] >> bits_, cube[2] >> bits_); }
  /// Number of the octant of a cube in its region.
  std::size_t octantOf(const OcTreeKey& cube) const {
    const unsigned m = static_cast<unsigned>(size()) - 1;
    return spread3((cube[0] & m) >> 2) | spread3((cube[1] & m) >> 2) << 1 | spread3((cube[2] & m) >> 2) << 2;
  }
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

  /// In the order in which they became known, which is much quicker than by hash.
  template <class F>
  void forEachColumn(F&& visit) const {
    for (std::size_t i = 0; i < in_order_.size(); ++i) {
      // Columns and regions lie all over the memory: ask for them some time before they are needed.
      if (i + 8 < in_order_.size()) __builtin_prefetch(in_order_[i + 8]);
      if (i + 4 < in_order_.size() && !in_order_[i + 4]->regions.empty())
        __builtin_prefetch(in_order_[i + 4]->regions.data());
      if (i + 2 < in_order_.size())
        for (const auto& region : in_order_[i + 2]->regions) __builtin_prefetch(region.get());
      visit(*in_order_[i]);
    }
  }

 private:
  static std::uint64_t nameOf(int x, int y) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) |
           static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32;
  }

  int bits_;
  Reader read_;
  BlockIndex<Column> columns_;
  std::vector<Column*> in_order_;  // the same
};

/// Bit of a cube in its octant.
inline int bitOf(const OcTreeKey& cube) { return cellIndex(cube, kRegionLevel) & 63; }
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

template <class F>
void forEachBit(std::uint64_t bits, F&& visit) {
  for (; bits != 0; bits &= bits - 1) visit(std::countr_zero(bits));
}

}  // namespace rhmap
