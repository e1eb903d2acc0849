// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/ray_cast.hpp"

#include <algorithm>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ray_cast.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

#include "ray_step-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// One lane: not for doing several things at once, but because vectors can choose without branches.
using F = hn::CappedTag<double, 1>;
using U = hn::RebindToUnsigned<F>;

void FollowRay(RayCast& ray, int bits, double limit) {
  const F f;
  const U u;
  auto tx = hn::Set(f, ray.t_max[0]), ty = hn::Set(f, ray.t_max[1]), tz = hn::Set(f, ray.t_max[2]);
  const auto dx = hn::Set(f, ray.t_delta[0]), dy = hn::Set(f, ray.t_delta[1]), dz = hn::Set(f, ray.t_delta[2]);
  auto cell = hn::Set(u, ray.mirrored);
  const auto mirror = hn::Set(u, ray.mirror);
  const std::uint64_t first = ray.mirrored, outside = cell_word::outsideOfCube(std::max(bits, 3));
  const std::size_t each = bits < 3 ? 1 : 0;
  std::size_t size = 0;
  std::uint64_t before, at = first;
  double entry;
  do {
    before = at;
    entry = hn::GetLane(hn::Min(hn::Min(tx, ty), tz));
    cell = advance(f, tx, ty, tz, dx, dy, dz, cell);
    at = hn::GetLane(cell);
    ray.path[size] = hn::GetLane(hn::Xor(cell, mirror));
    size += each;
  } while (((at ^ first) & outside) == 0 && entry <= limit);
  ray.size = size - each;
  ray.in_space = at > before;  // or else it has begun again at the other end
  ray.mirrored = ray.in_space ? at : before;
  ray.entry = entry;
  ray.t_max = {hn::GetLane(tx), hn::GetLane(ty), hn::GetLane(tz)};
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {
namespace {

/// Most of the steps inside of a cube, each axis by itself. Their order does not matter as long as all of them come
/// before the one that leaves; and those that come a cell and more before it certainly do.
void skipAhead(RayCast& ray, int bits, double limit) {
  OcTreeKey at = cell_word::toKey(ray.mirrored);
  const int last = (1 << bits) - 1;
  double until = limit;
  for (unsigned i = 0; i < 3; ++i) until = std::min(until, ray.t_max[i] + ray.t_delta[i] * (last - (at[i] & last)));
  std::array<double, 3> steps, t = ray.t_max;
  const std::array<double, 3> delta = ray.t_delta;
  for (unsigned i = 0; i < 3; ++i) {
    const int whole = static_cast<int>(std::max(0.0, (until - t[i]) / delta[i]));
    at[i] = static_cast<key_type>(at[i] + whole);
    steps[i] = whole;
  }
  // All axes in one loop: how often each of three would run is hard to guess.
  for (double k = 0, most = std::max({steps[0], steps[1], steps[2]}); k < most; ++k)
    for (unsigned i = 0; i < 3; ++i) t[i] += k < steps[i] ? delta[i] : 0.0;
  ray.t_max = t;
  ray.mirrored = cell_word::fromKey(at);
}

}  // namespace

RayCast::RayCast(const Ray& ray) : t_max(std::to_array(ray.t_max)), t_delta(std::to_array(ray.t_delta)) {
  for (int i = 0; i < 3; ++i)
    mirror |= ray.step[i] < 0 ? cell_word::kAxis[i] : 0;
  mirrored = cell_word::fromKey(ray.key) ^ mirror;
}

HWY_EXPORT(FollowRay);

void followRay(RayCast& ray, int bits, double limit) {
  if (bits > 3) skipAhead(ray, bits, limit);
  HWY_DYNAMIC_DISPATCH(FollowRay)(ray, bits, limit);
}

}  // namespace rhmap
#endif
