// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "cell_counters.hpp"
#include "rhmap/core/key.hpp"
#include "rhmap/core/popcount.hpp"
#include "tally.hpp"

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
  // Of scan Region::scan, if that has hit the octant:
  std::uint64_t hit = 0;       ///< cubes that it has hit
  std::uint64_t fresh = 0;     ///< of these, cubes that were not in the map before
  std::uint64_t appeared = 0;  ///< of these, cubes that past scans have seen through
};

/// Some cubes of an octant, which is named by its lowest cube.
struct CubesAt {
  OcTreeKey corner;
  std::uint64_t cubes;
};

/// What is counted and remembered of an octant's cubes. Apart from the masks, which are read far more often.
struct alignas(64) OctantHistory {
  Tally hits{};                         ///< scans that have hit a cube
  Tally misses{};                       ///< that have seen through it since its last hit; of none that is not doubted
  Counters<3> filled;                   ///< looks that have seen something at a cube's place
  std::uint64_t gone = 0;               ///< cubes that have been taken out of the map; some may be there again
  std::uint32_t first = 0;              ///< the first scan that has hit the octant; 0: none
  std::array<std::uint8_t, 8> scans{};  ///< scans that have hit each of its cells of the void, up to 255
};

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

/// Bit of a cube in its octant.
inline int bitOf(const OcTreeKey& cube) { return static_cast<int>(mortonOf(cube) & 63); }
inline constexpr std::uint64_t maskOf(int bit) { return std::uint64_t{1} << bit; }
/// Where the cube of a bit is in its octant.
inline constexpr std::array<std::array<std::uint8_t, 3>, 64> kPlaceInOctant = [] {
  std::array<std::array<std::uint8_t, 3>, 64> places{};
  for (unsigned bit = 0; bit < 64; ++bit)
    for (unsigned axis = 0; axis < 3; ++axis)
      places[bit][axis] = static_cast<std::uint8_t>((bit >> axis & 1) | (bit >> (axis + 2) & 2));
  return places;
}();
/// The cube of a bit, from the octant's lowest cube.
inline OcTreeKey cubeOf(const OcTreeKey& corner, int bit) {
  const auto& place = kPlaceInOctant[static_cast<std::size_t>(bit)];
  return {static_cast<key_type>(corner[0] + place[0]), static_cast<key_type>(corner[1] + place[1]),
          static_cast<key_type>(corner[2] + place[2])};
}
/// The lowest cube of a region's octant `o`, from the region's.
inline std::array<int, 3> cornerInRegion(std::size_t o) {
  const auto along = [o](int axis) { return static_cast<int>(gather3(static_cast<unsigned>(o >> axis)) << 2); };
  return {along(0), along(1), along(2)};
}
/// The lowest and the highest z (0 ... 3) of cubes of an octant of which there is one at least. Which they are is hard
/// to guess: the layers' bits are drawn together, instead of looked at one by one.
inline std::pair<int, int> layersOf(std::uint64_t cubes) {
  cubes |= cubes >> 16;
  cubes |= cubes >> 8;
  cubes |= cubes >> 2;
  cubes |= cubes >> 1;
  const auto layers = static_cast<unsigned>((cubes & 1) | (cubes >> 3 & 2) | (cubes >> 30 & 4) | (cubes >> 33 & 8));
  return {std::countr_zero(layers), std::bit_width(layers) - 1};
}

}  // namespace rhmap
