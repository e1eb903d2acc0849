// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "region_map.hpp"

namespace rhmap {

/// A plane of the ground, and where a region's lowest cube is from where it counts from.
struct NearPlane {
  const Plane* plane;
  float dx, dy, dz;
};

/// What is ground of what is above or below a plane [cubes].
struct GroundBand {
  float r_gro;  ///< less above it
  float depth;  ///< or no more below it
  float thin;   ///< no more above it, and it is safe
};

/// Cubes of an octant, whether they are in the map or not.
struct GroundCubes {
  std::uint64_t ground = 0;
  std::uint64_t safe = 0;  ///< of these
};

/// Eq. (5), for the planes of a region's surroundings, and the octant whose lowest cube is `corner`, from the region's.
/// In vectors; the same bits with any.
GroundCubes nearGround(std::span<const NearPlane> planes, const std::array<int, 3>& corner, const GroundBand& band);

}  // namespace rhmap
