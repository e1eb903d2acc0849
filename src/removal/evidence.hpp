// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "region_map.hpp"

namespace rhmap {

/// What is in and around an octant says.
struct Neighbourhood {
  int moving = 0;  ///< cubes that speak for something that has moved
  int firm = 0;    ///< cubes that stand
  int others = 0;  ///< cubes that are there besides, but for the ground

  /// A share of none is none. The other cubes count as so much of a firm one.
  bool isMoving(double share, double weight_of_others = 0) const {
    return moving > 0 && moving >= share * (moving + firm + weight_of_others * others);
  }
};

inline constexpr int kFarthestAround = 4;  ///< cubes around an octant: the 26 octants beside it as a whole

/// A distance [m] as so many cubes around an octant.
inline int cubesAround(double distance, double resolution) {
  return static_cast<int>(std::clamp(std::round(distance / resolution), 1.0, double(kFarthestAround)));
}

/// The cubes of an octant that are up to `reach` cubes (1 to 4) from the octant beside it, on the side of larger or
/// smaller coordinates of an axis.
constexpr std::uint64_t nearSide(unsigned axis, int reach, bool larger) {
  std::uint64_t cubes = 0;
  for (unsigned bit = 0; bit < 64; ++bit) {
    const int along = kPlaceInOctant[bit][axis];
    if (larger ? along >= 4 - reach : along < reach) cubes |= std::uint64_t{1} << bit;
  }
  return cubes;
}

/// For reach 1 to 4, each axis, and the octants before, at and after one's own: the cubes that are near.
inline constexpr auto kNearSides = [] {
  std::array<std::array<std::array<std::uint64_t, 3>, 3>, 4> sides{};
  for (std::size_t reach = 1; reach <= 4; ++reach)
    for (unsigned axis = 0; axis < 3; ++axis)
      sides[reach - 1][axis] = {nearSide(axis, static_cast<int>(reach), true), ~std::uint64_t{0},
                                nearSide(axis, static_cast<int>(reach), false)};
  return sides;
}();

/// Visits an octant (its lowest cube) and those of the 26 beside it that are known: visit(region, o, dx, dy, dz), the
/// region's octant `o` being so many octants from it.
template <class F>
void forEachOctantAround(const RegionMap& map, const OcTreeKey& corner, F&& visit) {
  // The regions around, each looked up once: two or three along an axis. Outside of the tree there are none.
  std::array<int, 3> first, last;
  for (unsigned axis = 0; axis < 3; ++axis) {
    first[axis] = (corner[axis] - 4) >> map.bits();
    last[axis] = (corner[axis] + 4) >> map.bits();
  }
  std::array<Region*, 27> regions;
  const auto regionAt = [&](int x, int y, int z) -> Region*& {
    return regions[static_cast<std::size_t>(9 * (x - first[0]) + 3 * (y - first[1]) + z - first[2])];
  };
  for (int x = first[0]; x <= last[0]; ++x)
    for (int y = first[1]; y <= last[1]; ++y)
      for (int z = first[2]; z <= last[2]; ++z)
        if (Region* region = regionAt(x, y, z) = map.find(x, y, z); region != nullptr) Region::prefetch(region);

  // All are asked for before the first is looked at.
  struct Known {
    Region* region;
    std::size_t o;
    int dx, dy, dz;
  };
  std::array<Known, 27> known;
  std::size_t n = 0;
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dz = -1; dz <= 1; ++dz) {
        const int x = corner[0] + 4 * dx, y = corner[1] + 4 * dy, z = corner[2] + 4 * dz;
        Region* region = regionAt(x >> map.bits(), y >> map.bits(), z >> map.bits());
        if (region == nullptr) continue;
        const OcTreeKey at(static_cast<key_type>(x), static_cast<key_type>(y), static_cast<key_type>(z));
        const std::size_t o = map.octantOf(at);
        if (!region->knows(o)) continue;
        __builtin_prefetch(&region->octant(o));
        known[n++] = {region, o, dx, dy, dz};
      }
    }
  }
  for (const auto& [of, o, dx, dy, dz] : std::span(known).first(n)) visit(*of, o, dx, dy, dz);
}

/// Sums up an octant (its lowest cube) and so many cubes (1 to 4) around it. `movingIn(region, o)` gives the cubes
/// of the first kind in the region's octant `o`.
template <class MovingIn>
Neighbourhood lookAround(const RegionMap& map, const OcTreeKey& corner, int reach, MovingIn&& movingIn) {
  Neighbourhood around;
  const auto& near = kNearSides[static_cast<std::size_t>(reach - 1)];
  forEachOctantAround(map, corner, [&](const Region& region, std::size_t o, int dx, int dy, int dz) {
    const Octant& octant = region.octant(o);
    const std::uint64_t within = near[0][static_cast<std::size_t>(dx + 1)] & near[1][static_cast<std::size_t>(dy + 1)] &
                                 near[2][static_cast<std::size_t>(dz + 1)];
    const std::uint64_t moving = movingIn(region, o) & within;
    const std::uint64_t firm = octant.firm & ~octant.doubted & ~octant.ground & ~moving & within;
    const std::uint64_t others = octant.occupied & ~octant.ground & ~moving & ~firm & within;
    if (moving != 0) around.moving += popcount(moving);  // most have none of either
    if (firm != 0) around.firm += popcount(firm);
    if (others != 0) around.others += popcount(others);
  });
  return around;
}

}  // namespace rhmap
