// SPDX-License-Identifier: BSD-3-Clause
#include "void_rays.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "void_rays.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;
using MF = hn::Mask<F>;

constexpr std::size_t kMostLanes = HWY_MAX_BYTES / sizeof(float);

/// An axis of the rays in the lanes.
struct Axis {
  VI cell, step;
  VF next, delta;  ///< shares of the rays at the next side of a cell, and from side to side

  HWY_INLINE Axis(VF to, float from, int origin) {
    const F f;
    const I i;
    const VF d = hn::Sub(to, hn::Set(f, from)), zero = hn::Zero(f), never = hn::Set(f, 1e30F);
    const MF back = hn::Lt(d, zero), none = hn::Eq(d, zero);
    const auto first = static_cast<std::int32_t>(from);
    cell = hn::Set(i, first - origin);
    step = hn::IfThenElse(hn::RebindMask(i, back), hn::Set(i, -1), hn::Set(i, 1));
    delta = hn::IfThenElse(none, never, hn::Abs(hn::Div(hn::Set(f, 1), d)));
    const VF side = hn::Set(f, static_cast<float>(first) - from),
             other = hn::Set(f, static_cast<float>(first + 1) - from);
    next = hn::IfThenElse(none, never, hn::Div(hn::IfThenElse(back, side, other), d));
  }

  HWY_INLINE void advance(MF lanes) {
    const I i;
    next = hn::Add(next, hn::IfThenElseZero(lanes, delta));
    cell = hn::Add(cell, hn::IfThenElseZero(hn::RebindMask(i, lanes), step));
  }
};

/// `busy`: lanes that have a ray.
HWY_INLINE void followLanes(const std::array<float, 3>& from, VF to_x, VF to_y, VF to_z, VF share, MF busy,
                            const CellGrid& hit, CellGrid& crossed) {
  const F f;
  const I i;
  Axis x(to_x, from[0], crossed.x0()), y(to_y, from[1], crossed.y0()), z(to_z, from[2], crossed.z0());
  const VI side = hn::Set(i, crossed.side()), height = hn::Set(i, 64), none = hn::Set(i, -1);
  const std::uint64_t* hit_words = hit.data();
  std::uint64_t* crossed_words = crossed.data();
  alignas(64) std::int32_t word[kMostLanes], above[kMostLanes];
  const std::size_t lanes = hn::Lanes(f);
  while (true) {
    const auto inside = [&](const Axis& axis, VI end)
                            HWY_ATTR { return hn::And(hn::Gt(axis.cell, none), hn::Lt(axis.cell, end)); };
    busy = hn::And(busy, hn::RebindMask(f, hn::And(inside(x, side), hn::And(inside(y, side), inside(z, height)))));
    if (hn::AllFalse(f, busy)) return;
    hn::Store(hn::IfThenElse(hn::RebindMask(i, busy), hn::Add(hn::Mul(y.cell, side), x.cell), none), i, word);
    hn::Store(z.cell, i, above);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (word[lane] < 0) continue;
      const auto at = static_cast<std::size_t>(word[lane]);
      const std::uint64_t bit = std::uint64_t{1} << above[lane];
      if ((hit_words[at] & bit) != 0) {
        word[lane] = -1;
      } else {
        crossed_words[at] |= bit;
      }
    }
    busy = hn::And(busy, hn::RebindMask(f, hn::Ne(hn::Load(i, word), none)));

    const MF along_x = hn::And(hn::Le(x.next, y.next), hn::Le(x.next, z.next));
    const MF along_y = hn::AndNot(along_x, hn::Le(y.next, z.next));
    const MF along_z = hn::Not(hn::Or(along_x, along_y));
    busy = hn::And(busy, hn::Le(hn::IfThenElse(along_x, x.next, hn::IfThenElse(along_y, y.next, z.next)), share));
    x.advance(along_x), y.advance(along_y), z.advance(along_z);
  }
}

void FollowRays(const std::array<float, 3>& from, const VoidRays& rays, const CellGrid& hit, CellGrid& crossed) {
  const F f;
  const std::size_t lanes = hn::Lanes(f);
  std::size_t k = 0;
  for (; k + lanes <= rays.size(); k += lanes)
    followLanes(from, hn::LoadU(f, &rays.x[k]), hn::LoadU(f, &rays.y[k]), hn::LoadU(f, &rays.z[k]),
                hn::LoadU(f, &rays.share[k]), hn::FirstN(f, lanes), hit, crossed);
  const std::size_t rest = rays.size() - k;
  if (rest == 0) return;
  alignas(64) float last[4][kMostLanes] = {};
  std::copy_n(&rays.x[k], rest, last[0]);
  std::copy_n(&rays.y[k], rest, last[1]);
  std::copy_n(&rays.z[k], rest, last[2]);
  std::copy_n(&rays.share[k], rest, last[3]);
  followLanes(from, hn::Load(f, last[0]), hn::Load(f, last[1]), hn::Load(f, last[2]), hn::Load(f, last[3]),
              hn::FirstN(f, rest), hit, crossed);
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {

HWY_EXPORT(FollowRays);

void followRays(const std::array<float, 3>& from, const VoidRays& rays, const CellGrid& hit, CellGrid& crossed) {
  HWY_DYNAMIC_DISPATCH(FollowRays)(from, rays, hit, crossed);
}

}  // namespace rhmap
#endif
