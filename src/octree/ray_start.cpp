// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/ray_start.hpp"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ray_start.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

#include "compress-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<double>;
using U = hn::RebindToUnsigned<F>;
using I = hn::RebindToSigned<F>;
using S = hn::Rebind<float, F>;  // single precision, as many lanes
using VF = hn::Vec<F>;
using VU = hn::Vec<U>;
using VS = hn::Vec<S>;
using MF = hn::Mask<F>;
using MU = hn::Mask<U>;
using MS = hn::Mask<S>;

struct Points {
  VS x, y, z;
};

/// octomath's norm(): squares and sum in float, the root in double.
HWY_INLINE VF norm(const Points& v) {
  return hn::Sqrt(hn::PromoteTo(F(), hn::Add(hn::Add(hn::Mul(v.x, v.x), hn::Mul(v.y, v.y)), hn::Mul(v.z, v.z))));
}

HWY_INLINE MF wide(MS narrow) {
  // By way of a value: Highway 1.0 has no conversion between masks of different widths.
  return hn::Ne(hn::PromoteTo(F(), hn::IfThenElseZero(narrow, hn::Set(S(), 1.0F))), hn::Zero(F()));
}
HWY_INLINE MS narrow(MF wide) {
  return hn::Ne(hn::DemoteTo(S(), hn::IfThenElseZero(wide, hn::Set(F(), 1.0))), hn::Zero(S()));
}

HWY_INLINE VS select(MS which, VS yes, VS no) { return hn::IfThenElse(which, yes, no); }

/// Keys along an axis, and whether they are inside of the tree: KeySpace::coordToKeyChecked.
HWY_INLINE VU keyOf(VS coordinate, double inverse_resolution, MF& inside) {
  const F f;
  const VF scaled = hn::Floor(hn::Mul(hn::Set(f, inverse_resolution), hn::PromoteTo(f, coordinate)));
  const MF here =
      hn::And(hn::Ge(scaled, hn::Set(f, -double(kTreeMaxVal))), hn::Lt(scaled, hn::Set(f, double(kTreeMaxVal))));
  inside = hn::And(inside, here);
  const auto cell = hn::ConvertTo(I(), hn::IfThenElseZero(here, scaled));
  return hn::BitCast(U(), hn::Add(cell, hn::Set(I(), std::int64_t{kTreeMaxVal})));
}

/// An axis' part of a cell word: bit 0 of the key to bit `low`, the next two three bits up each, the rest to bit
/// `high`.
template <int kLow, int kHigh>
HWY_INLINE VU wordOf(VU key) {
  const U u;
  const auto bit = [&](std::uint64_t b) HWY_ATTR { return hn::And(key, hn::Set(u, b)); };
  const VU cell = hn::Or(bit(1), hn::Or(hn::ShiftLeft<2>(bit(2)), hn::ShiftLeft<4>(bit(4))));
  return hn::Or(hn::ShiftLeft<kLow>(cell), hn::ShiftLeft<kHigh>(hn::ShiftRight<3>(key)));
}

/// The first border and the distance between borders along an axis: startAxis() of ray.cpp.
struct Axis {
  VF t_max, t_delta;
  MF down;
};
HWY_INLINE Axis axisOf(VS direction, const RayOrigin& origin, std::size_t axis) {
  const F f;
  const VF d = hn::PromoteTo(f, direction);
  const VF zero = hn::Zero(f);
  const MF up = hn::Gt(d, zero);
  const MF down = hn::Lt(d, zero);
  const MF level = hn::Not(hn::Or(up, down));
  const VF never = hn::Set(f, std::numeric_limits<double>::max());
  const VF border = hn::IfThenElse(up, hn::Set(f, origin.up[axis]), hn::Set(f, origin.down[axis]));
  return {hn::IfThenElse(level, never, hn::Div(border, d)),
          hn::IfThenElse(level, never, hn::Div(hn::Set(f, origin.resolution), hn::Abs(d))), down};
}

/// The rays to the first `count` of a vector of points.
HWY_INLINE void startVector(const RayOrigin& origin, const float* points, std::size_t count, RayBatch& rays,
                            HitCells& hits, RayCounts& counts) {
  const F f;
  const U u;
  const S s;
  Points end;
  hn::LoadInterleaved3(s, points, end.x, end.y, end.z);
  const VS most = hn::Set(s, std::numeric_limits<float>::max());
  const MF given = hn::RebindMask(f, hn::FirstN(u, count));
  const MF finite = hn::And(given, wide(hn::And(hn::And(hn::Le(hn::Abs(end.x), most), hn::Le(hn::Abs(end.y), most)),
                                                hn::Le(hn::Abs(end.z), most))));
  counts.not_finite += count - hn::CountTrue(f, finite);

  // The range.
  const VS x = hn::Set(s, origin.point[0]), y = hn::Set(s, origin.point[1]), z = hn::Set(s, origin.point[2]);
  MF in_range = finite;
  if (!(origin.max_range < 0.0)) {
    const Points v{hn::Sub(end.x, x), hn::Sub(end.y, y), hn::Sub(end.z, z)};
    const VF length = norm(v);
    const MF within = hn::Le(length, hn::Set(f, origin.max_range));
    in_range = hn::And(finite, within);
    if (!hn::AllTrue(f, within)) {  // cutAt()
      const VS divisor = select(narrow(hn::Gt(length, hn::Zero(f))), hn::DemoteTo(s, length), hn::Set(s, 1.0F));
      const VS range = hn::Set(s, static_cast<float>(origin.max_range));
      const MS keep = narrow(within);
      end.x = select(keep, end.x, hn::Add(x, hn::Mul(hn::Div(v.x, divisor), range)));
      end.y = select(keep, end.y, hn::Add(y, hn::Mul(hn::Div(v.y, divisor), range)));
      end.z = select(keep, end.z, hn::Add(z, hn::Mul(hn::Div(v.z, divisor), range)));
    }
  }

  MF inside = finite;
  const VU end_word = hn::Or(hn::Or(wordOf<0, 9>(keyOf(end.x, origin.inverse_resolution, inside)),
                                    wordOf<1, 22>(keyOf(end.y, origin.inverse_resolution, inside))),
                             wordOf<2, 35>(keyOf(end.z, origin.inverse_resolution, inside)));
  const MU hit = hn::RebindMask(u, hn::And(inside, in_range));
  storeCompressed(u, end_word, hit, hits.cell.data() + hits.size);
  hits.size += hn::CountTrue(u, hit);
  if (!origin.inside) {
    counts.outside += hn::CountTrue(f, finite);
    return;
  }
  counts.outside += hn::CountTrue(f, hn::AndNot(inside, finite));

  // The ray.
  const MU moves = hn::And(hn::RebindMask(u, inside), hn::Ne(end_word, hn::Set(u, origin.cell)));
  const MF moves_f = hn::RebindMask(f, moves);
  const Points v{hn::Sub(end.x, x), hn::Sub(end.y, y), hn::Sub(end.z, z)};
  const VS length = hn::DemoteTo(s, norm(v));
  const Axis along_x = axisOf(hn::Div(v.x, length), origin, 0);
  const Axis along_y = axisOf(hn::Div(v.y, length), origin, 1);
  const Axis along_z = axisOf(hn::Div(v.z, length), origin, 2);
  const auto axisBits = [&](const Axis& axis, int i) HWY_ATTR {
    return hn::IfThenElseZero(hn::RebindMask(u, axis.down), hn::Set(u, cell_word::kAxis[i]));
  };
  const VU mirror = hn::Or(hn::Or(axisBits(along_x, 0), axisBits(along_y, 1)), axisBits(along_z, 2));

  const std::size_t at = RayBatch::kPad + rays.size();
  storeCompressed(f, along_x.t_max, moves_f, rays.t_max[0].data() + at);
  storeCompressed(f, along_y.t_max, moves_f, rays.t_max[1].data() + at);
  storeCompressed(f, along_z.t_max, moves_f, rays.t_max[2].data() + at);
  storeCompressed(f, along_x.t_delta, moves_f, rays.t_delta[0].data() + at);
  storeCompressed(f, along_y.t_delta, moves_f, rays.t_delta[1].data() + at);
  storeCompressed(f, along_z.t_delta, moves_f, rays.t_delta[2].data() + at);
  storeCompressed(f, hn::PromoteTo(f, length), moves_f, rays.length.data() + at);
  storeCompressed(u, mirror, moves, rays.mirror.data() + at);
  storeCompressed(u, hn::Xor(hn::Set(u, origin.cell), mirror), moves, rays.cell.data() + at);
  storeCompressed(u, hn::Xor(end_word, mirror), moves, rays.end.data() + at);
  rays.grow(hn::CountTrue(u, moves));
}

RayCounts StartRays(const RayOrigin& origin, const float* points, std::size_t count, RayBatch& rays, HitCells& hits) {
  const std::size_t width = hn::Lanes(F());
  RayCounts counts;
  std::size_t i = 0;
  for (; i + width <= count; i += width) startVector(origin, points + 3 * i, width, rays, hits, counts);
  if (i < count) {
    float rest[3 * HWY_MAX_BYTES / sizeof(double)] = {};
    std::copy(points + 3 * i, points + 3 * count, rest);
    startVector(origin, rest, count - i, rays, hits, counts);
  }
  return counts;
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {

HWY_EXPORT(StartRays);

RayOrigin::RayOrigin(const KeySpace& keys, const octomap::point3d& origin, double range)
    : point{origin.x(), origin.y(), origin.z()},
      max_range(range),
      resolution(keys.resolution()),
      inverse_resolution(keys.inverseResolution()) {
  OcTreeKey key(0, 0, 0);
  inside = keys.coordToKeyChecked(origin, key);
  cell = cell_word::fromKey(key);
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto border = [&](double step) {  // half a cell in float, as in computeRayKeys
      return keys.keyToCoord(key[axis]) + double(static_cast<float>(step * resolution * 0.5)) - double(origin(axis));
    };
    up[axis] = border(1);
    down[axis] = border(-1);
  }
}

RayCounts startRays(const RayOrigin& origin, std::span<const octomap::point3d> points, RayBatch& rays, HitCells& hits) {
  static_assert(sizeof(octomap::point3d) == 3 * sizeof(float));
  return HWY_DYNAMIC_DISPATCH(StartRays)(origin, reinterpret_cast<const float*>(points.data()), points.size(), rays,
                                         hits);
}

}  // namespace rhmap
#endif
