// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "region_map.hpp"

namespace rhmap {

/// What the octant of a cube and the 26 around it say.
struct Neighbourhood {
  int moving = 0;  ///< cubes that speak for something that has moved
  int firm = 0;    ///< cubes that stand

  /// A share of none is none.
  bool isMoving(double share) const { return moving > 0 && moving >= share * (moving + firm); }
};

/// Sums up around an octant (its lowest cube). `movingIn(region, octant)` gives the octant's cubes of the first kind.
template <class MovingIn>
Neighbourhood lookAround(const RegionMap& map, const OcTreeKey& corner, MovingIn&& movingIn) {
  Neighbourhood around;
  const Region* region = nullptr;
  for (int dx = -4; dx <= 4; dx += 4) {
    for (int dy = -4; dy <= 4; dy += 4) {
      for (int dz = -4; dz <= 4; dz += 4) {
        const OcTreeKey at(static_cast<key_type>(corner[0] + dx), static_cast<key_type>(corner[1] + dy),
                           static_cast<key_type>(corner[2] + dz));
        const int x = at[0] >> map.bits(), y = at[1] >> map.bits(), z = at[2] >> map.bits();
        if (region == nullptr || region->x != x || region->y != y || region->z != z) region = map.find(x, y, z);
        if (region == nullptr) continue;
        const Octant& octant = region->octants[map.octantOf(at)];
        const std::uint64_t moving = movingIn(*region, octant);
        around.moving += std::popcount(moving);
        around.firm += std::popcount(octant.firm & ~octant.doubted & ~octant.ground & ~moving);
      }
    }
  }
  return around;
}

}  // namespace rhmap
