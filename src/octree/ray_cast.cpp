// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>

#include "rhmap/octree/ray.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ray_cast.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// One lane: not for doing several things at once, but because vectors can choose without branches, and the next axis of
// a ray is hard to guess.
using F = hn::CappedTag<double, 1>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using MF = hn::Mask<F>;

/// All bits where the mask is set.
HWY_INLINE std::uint32_t bitsOf(MF mask) {
  return static_cast<std::uint32_t>(hn::GetLane(hn::VecFromMask(I(), hn::RebindMask(I(), mask))));
}

RayEntry LeaveCube(Ray& ray, int bits, double limit) {
  const F f;
  VF tx = hn::Set(f, ray.t_max[0]), ty = hn::Set(f, ray.t_max[1]), tz = hn::Set(f, ray.t_max[2]);
  const VF dx = hn::Set(f, ray.t_delta[0]), dy = hn::Set(f, ray.t_delta[1]), dz = hn::Set(f, ray.t_delta[2]);
  const auto sx = static_cast<std::uint32_t>(ray.step[0]), sy = static_cast<std::uint32_t>(ray.step[1]),
             sz = static_cast<std::uint32_t>(ray.step[2]);
  std::uint32_t kx = ray.key[0], ky = ray.key[1], kz = ray.key[2];
  const std::uint32_t fx = kx, fy = ky, fz = kz;
  double entry;
  do {
    const MF x_before_y = hn::Lt(tx, ty);
    const VF first = hn::Min(tx, ty);
    const MF z = hn::Le(tz, first);
    const MF x = hn::AndNot(z, x_before_y);
    const MF y = hn::AndNot(z, hn::Not(x_before_y));
    entry = hn::GetLane(hn::Min(first, tz));
    tx = hn::IfThenElse(x, hn::Add(tx, dx), tx);
    ty = hn::IfThenElse(y, hn::Add(ty, dy), ty);
    tz = hn::IfThenElse(z, hn::Add(tz, dz), tz);
    kx += sx & bitsOf(x);
    ky += sy & bitsOf(y);
    kz += sz & bitsOf(z);
  } while (((kx ^ fx) | (ky ^ fy) | (kz ^ fz)) >> bits == 0 && entry <= limit);
  // At most one of them, by the last step.
  const bool in_space = ((kx | ky | kz) >> 16) == 0;
  const auto keyOf = [](std::uint32_t k) { return static_cast<key_type>(k >> 16 == 0 ? k : k >> 31 ? 0 : 0xffff); };
  ray.key = OcTreeKey(keyOf(kx), keyOf(ky), keyOf(kz));
  ray.t_max[0] = hn::GetLane(tx);
  ray.t_max[1] = hn::GetLane(ty);
  ray.t_max[2] = hn::GetLane(tz);
  return {entry, in_space};
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {

HWY_EXPORT(LeaveCube);

RayEntry leaveCube(Ray& ray, int bits, double limit) { return HWY_DYNAMIC_DISPATCH(LeaveCube)(ray, bits, limit); }

}  // namespace rhmap
#endif
