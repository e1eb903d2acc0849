// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "octant.hpp"
#include "octant_pool.hpp"
#include "rhmap/core/block_index.hpp"
#include "rhmap/core/prefetch.hpp"
#include "rhmap/core/record_pool.hpp"

namespace rhmap {

/// n . I = d: a plane of the ground in cubes, from the lowest cube of its region.
struct Plane {
  std::array<float, 3> n{0, 0, 1};
  float d = 0;

  float above(float x, float y, float z) const { return n[0] * x + n[1] * y + n[2] * z - d; }
};

struct Column;

/// Whose turn it is goes over the columns from scan to scan, so that all scans have the same to do.
inline std::uint32_t turnOf(key_type x, key_type y, std::uint32_t scan) { return x + y + scan; }

/// M_{I_r}: a region, a cube of 4, 8 or 16 cubes an axis. One line of the cache; the places of its octants follow.
struct alignas(64) Region {
  key_type x = 0, y = 0, z = 0;     ///< I_r >> bits
  std::uint16_t cubes = 0;          ///< in the map
  std::uint32_t scan = 0;           ///< the last scan that hit it
  bool doubtful = false;            ///< there may be cubes that are doubted
  std::uint64_t known_octants = 0;  ///< those that a scan has ever hit, or that the tree had cubes in
  std::uint64_t hit_octants = 0;    ///< those that the scan has hit
  std::uint64_t fresh_octants = 0;  ///< of these, those with cubes that were not in the map before
  std::uint64_t loose_octants = 0;  ///< those that may have cubes that are not safe
  Column* column = nullptr;         ///< the one that it stands in

  /// An octant, in Morton order. Those that are not known are one, without cubes, and must not be written to.
  [[gnu::always_inline]] Octant& octant(std::size_t o) const { return *places()[o]; }
  [[gnu::always_inline]] Octant** places() const { return reinterpret_cast<Octant**>(const_cast<Region*>(this) + 1); }
  bool knows(std::size_t o) const { return (known_octants >> o & 1) != 0; }

  /// Asks for the memory of the region, and of the places of its octants (see BlockIndex::prefetch).
  [[gnu::always_inline]] static void prefetch(const Region* region) {
    __builtin_prefetch(region);
    __builtin_prefetch(region + 1);
  }

  /// Whether what an octant says of hits is said of the scan of this number.
  bool isHitBy(std::uint32_t number, std::size_t o) const { return scan == number && (hit_octants >> o & 1) != 0; }

  /// Puts cubes of a known octant that are not there yet into the map.
  void add(std::size_t o, std::uint64_t new_cubes) {
    octant(o).occupied |= new_cubes;
    loose_octants |= std::uint64_t{new_cubes != 0} << o;
    cubes = static_cast<std::uint16_t>(cubes + popcount(new_cubes));
  }
  /// Notes the doubtful cubes of an octant, if there are any.
  void noteDoubts(std::size_t o);
  /// Takes cubes of an octant that are there out of the map.
  void remove(std::size_t o, std::uint64_t old_cubes);
};

/// Where the columns around one are, in columns: four beside it, four across its corners. What is at kAround[i] from a
/// column has that at kAround[i ^ 1].
struct Offset {
  int x, y;
};
inline constexpr std::array<Offset, 8> kAround{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, 1}, {-1, 1}, {1, -1}}};
inline constexpr std::size_t kBeside = 4;

/// The regions above each other at one O_r, and H{max,min}(O_r). One line of the cache, and one for who is around: the
/// ground is looked at from column to column.
struct alignas(64) Column {
  key_type x = 0, y = 0;               ///< O_r >> bits
  key_type h_min = 0xffff, h_max = 0;  ///< keys of the lowest and the highest cube; none: max < min
  bool doubtful = false;               ///< so may one of its regions be
  bool stale = false;                  ///< cubes were removed since h_min and h_max were computed
  bool thinned = false;                ///< cubes were removed
  bool has_ground = false;             ///< `ground` is the ground's, in its base
  key_type base_z = 0;                 ///< that of `base`
  std::uint16_t at_fit = 0;            ///< cubes of the base at the last try to fit a plane
  Region* base = nullptr;              ///< where R-GPE looks for ground: the lowest region with a cube
  std::vector<Region*> regions;        ///< by z, ascending
  Plane ground;
  std::array<Column*, 8> around{};  ///< those at kAround from it; null where none is known

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

/// Asks for these octants of a region (see BlockIndex::prefetch).
[[gnu::always_inline]] inline void prefetchOctants(const Region& region, std::uint64_t octants) {
  for (; octants != 0; octants &= octants - 1)
    __builtin_prefetch(&region.octant(static_cast<std::size_t>(std::countr_zero(octants))));
}

/// Visits the columns columnAt(0) ... columnAt(n - 1). They lie all over the memory: asks for them, their lists and
/// their regions some time before they are needed, and then askFor(column) for what else is.
template <class ColumnAt, class AskFor, class F>
void visitColumns(std::size_t n, ColumnAt&& columnAt, AskFor&& askFor, F&& visit) {
  constexpr std::size_t kAhead = 4;
  for (std::size_t i = 0; i < n; ++i) {
    if (i + 4 * kAhead < n) prefetchWhole(columnAt(i + 4 * kAhead));
    if (i + 3 * kAhead < n) __builtin_prefetch(columnAt(i + 3 * kAhead)->regions.data());
    if (i + 2 * kAhead < n)
      for (const Region* region : columnAt(i + 2 * kAhead)->regions) Region::prefetch(region);
    if (i + kAhead < n) askFor(*columnAt(i + kAhead));
    visit(*columnAt(i));
  }
}

inline void Region::noteDoubts(std::size_t o) {
  if (octant(o).doubted != 0) doubtful = column->doubtful = true;
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
  Octant& getOrCreate(Region& region, std::size_t o) {
    if (!region.knows(o)) makeOctant(region, o);
    return region.octant(o);
  }
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
  [[gnu::always_inline]] void prefetch(int x, int y) const { columns_.prefetch(nameOf(x, y)); }

  /// The region that holds a cube, if it is known.
  Region* regionOf(const OcTreeKey& cube) const { return find(nameOf(cube)); }
  /// Number of the octant of a cube in its region.
  std::size_t octantOf(const OcTreeKey& cube) const { return mortonOf(cube) >> 6 & (octants() - 1); }
  /// Lowest cube of octant `o` of a region.
  OcTreeKey cornerOf(const Region& region, std::size_t o) const {
    const auto [x, y, z] = cornerInRegion(o);
    return {static_cast<key_type>((region.x << bits_) + x), static_cast<key_type>((region.y << bits_) + y),
            static_cast<key_type>((region.z << bits_) + z)};
  }

  /// Lowest and highest cube of a region, as keys; max < min if it has none.
  std::pair<int, int> heights(const Region& region) const;
  /// H{max,min} after removals.
  void refreshHeights(Column& column) const;

  /// Forgets the columns farther than this many cubes (along an axis) from a cube.
  void forgetBeyond(const OcTreeKey& centre, int distance);

  std::size_t numColumns() const { return columns_.size(); }
  std::size_t memoryUsage() const;

  /// Visits those that are `due`, of those that may be due by their place: mayBeDue(x, y), due(column), visit(column).
  /// In the order in which they became known, which is much quicker than by hash. Of their regions the loose octants
  /// are likely to be needed.
  template <class MayBeDue, class Due, class F>
  void forEachColumn(MayBeDue&& mayBeDue, Due&& due, F&& visit) const {
    constexpr std::size_t kAhead = 12;
    std::vector<Column*> columns;
    for (const Place& place : in_order_)
      if (mayBeDue(place.x, place.y)) columns.push_back(place.column);
    std::size_t n = 0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (i + kAhead < columns.size()) __builtin_prefetch(columns[i + kAhead]);
      if (due(*columns[i])) columns[n++] = columns[i];
    }
    const auto askFor = [](const Column& column) __attribute__((always_inline)) {
      for (const Region* region : column.regions) prefetchOctants(*region, region->loose_octants);
    };
    visitColumns(
        n, [&](std::size_t i) { return columns[i]; }, askFor, visit);
  }
  template <class F>
  void forEachColumn(F&& visit) const {
    forEachColumn([](key_type, key_type) { return true; }, [](const Column&) { return true; }, visit);
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
  void makeOctant(Region& region, std::size_t o);

  int bits_;
  Reader read_;
  PiecePool pieces_{true};
  RecordPool column_pool_{pieces_, {.bytes = sizeof(Column)}};
  RecordPool region_pool_;  // each with the places of its octants
  OctantPool octant_pool_{pieces_};
  BlockIndex<Column> columns_;
  BlockIndex<Region> regions_;
  struct Place {
    key_type x, y;
    Column* column;
  };
  std::vector<Place> in_order_;  // the same
};

}  // namespace rhmap
