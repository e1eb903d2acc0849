// SPDX-License-Identifier: BSD-3-Clause
#include "near_ground.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "near_ground.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

#ifndef RHMAP_NEAR_GROUND_PLACES
#define RHMAP_NEAR_GROUND_PLACES
namespace rhmap {

/// kPlaceInOctant, a list for each axis.
inline constexpr auto kPlacesAlong = [] {
  std::array<std::array<float, 64>, 3> places{};
  for (std::size_t bit = 0; bit < 64; ++bit)
    for (std::size_t axis = 0; axis < 3; ++axis) places[axis][bit] = kPlaceInOctant[bit][axis];
  return places;
}();

}  // namespace rhmap
#endif

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, 16>;

/// Of lanes i, i + 1, ...
HWY_INLINE std::uint64_t bitsOf(hn::Mask<F> lanes, std::size_t i) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(F(), lanes, bits);
  return std::uint64_t{static_cast<unsigned>(bits[0] | bits[1] << 8)} << i;
}

GroundCubes NearGround(const NearPlane* planes, std::size_t n, const std::array<int, 3>& corner,
                       const GroundBand& band) {
  const F f;
  GroundCubes cubes;
  for (std::size_t i = 0; i < 64; i += hn::Lanes(f)) {
    auto lowest = hn::Set(f, band.r_gro);
    for (const NearPlane* near = planes; near != planes + n; ++near) {
      const Plane& plane = *near->plane;
      const auto part = [&](unsigned axis, float from) HWY_ATTR {
        const auto place =
            hn::Add(hn::LoadU(f, kPlacesAlong[axis].data() + i), hn::Set(f, from + static_cast<float>(corner[axis])));
        return hn::Mul(hn::Set(f, plane.n[axis]), place);
      };
      const auto sum = hn::Add(hn::Add(part(0, near->dx), part(1, near->dy)), part(2, near->dz));
      const auto above = hn::Sub(sum, hn::Set(f, plane.d));  // Plane::above
      const auto counts = hn::And(hn::Ge(above, hn::Set(f, -band.depth)), hn::Lt(above, lowest));
      lowest = hn::IfThenElse(counts, above, lowest);
    }
    cubes.ground |= bitsOf(hn::Lt(lowest, hn::Set(f, band.r_gro)), i);
    cubes.safe |= bitsOf(hn::Le(lowest, hn::Set(f, band.thin)), i);
  }
  cubes.safe &= cubes.ground;
  return cubes;
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {

HWY_EXPORT(NearGround);

GroundCubes nearGround(std::span<const NearPlane> planes, const std::array<int, 3>& corner, const GroundBand& band) {
  return HWY_DYNAMIC_DISPATCH(NearGround)(planes.data(), planes.size(), corner, band);
}

}  // namespace rhmap
#endif
