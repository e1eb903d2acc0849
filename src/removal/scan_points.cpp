// SPDX-License-Identifier: BSD-3-Clause
#include "scan_points.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scan_points.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#ifndef RHMAP_SCAN_POINTS_TRANSFORM
#define RHMAP_SCAN_POINTS_TRANSFORM
namespace rhmap {

/// octomap::Pose6D::transform, written out: q * p * q^-1 + t.
struct Transform {
  explicit Transform(const octomap::pose6d& pose)
      : u(pose.rot().u()), x(pose.rot().x()), y(pose.rot().y()), z(pose.rot().z()) {
    const octomath::Quaternion inverse = pose.rot().inv();
    iu = inverse.u(), ix = inverse.x(), iy = inverse.y(), iz = inverse.z();
    for (unsigned i = 0; i < 3; ++i) t[i] = pose.trans()(i);
  }

  float u, x, y, z, iu, ix, iy, iz;
  float t[3];
};

constexpr std::size_t kMostLanes = 32;  // of a vector of double, whatever the instruction set

/// Where the points go: to the lists of a scan, from where the next one is due.
struct LocatedPoints {
  float *x, *y, *z, *range;
  std::uint64_t* cell;
  std::size_t n;  ///< so far
};

/// Of points that count.
struct RangeLimits {
  double nearest, farthest;
};

}  // namespace rhmap
#endif

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using F = hn::Rebind<float, D>;
using U = hn::RebindToUnsigned<D>;
using VF = hn::Vec<F>;
using VU = hn::Vec<U>;

/// Eq. (1) along one axis; where that is outside of the tree, takes the lane out of `inside`.
HWY_INLINE VU keysOf(VF world, double cells_per_metre, hn::Mask<D>& inside) {
  const D d;
  const auto cell = hn::Floor(hn::Mul(hn::Set(d, cells_per_metre), hn::PromoteTo(d, world)));
  const auto half = hn::Set(d, double(kTreeMaxVal));
  inside = hn::And(inside, hn::And(hn::Ge(cell, hn::Neg(half)), hn::Lt(cell, half)));  // NaN is not
  const auto key = hn::IfThenElseZero(inside, hn::Add(cell, half));
  return hn::PromoteTo(U(), hn::BitCast(hn::RebindToUnsigned<F>(), hn::DemoteTo(hn::RebindToSigned<F>(), key)));
}

/// cell_word::fromKey
HWY_INLINE VU cellsOf(VU x, VU y, VU z) {
  const U u;
  const auto all = [u](std::uint64_t value) HWY_ATTR { return hn::Set(u, value); };
  const auto key = hn::Or(hn::Or(x, hn::ShiftLeft<16>(y)), hn::ShiftLeft<32>(z));
  auto low = hn::And(key, all(0x0007'0007'0007));
  low = hn::And(hn::Or(hn::Or(low, hn::ShiftLeft<2>(low)), hn::ShiftLeft<4>(low)), all(0x0049'0049'0049));
  low = hn::And(hn::Or(hn::Or(low, hn::ShiftRight<15>(low)), hn::ShiftRight<30>(low)), all(511));
  const auto region = hn::Or(hn::Or(hn::And(hn::ShiftLeft<6>(key), all(std::uint64_t{0x1fff} << 9)),
                                    hn::And(hn::ShiftLeft<3>(key), all(std::uint64_t{0x1fff} << 22))),
                             hn::And(key, all(std::uint64_t{0x1fff} << 35)));
  return hn::Or(region, low);
}

/// As many points as there are lanes, to the lists; which of them to keep.
HWY_INLINE hn::Mask<D> locate(const Transform& pose, double cells_per_metre, const RangeLimits& limits,
                              const float* points, const LocatedPoints& to) {
  const D d;
  const F f;
  const auto all = [f](float value) HWY_ATTR { return hn::Set(f, value); };
  const auto u = all(pose.u), x = all(pose.x), y = all(pose.y), z = all(pose.z);
  const auto iu = all(pose.iu), ix = all(pose.ix), iy = all(pose.iy), iz = all(pose.iz);
  VF px, py, pz;
  hn::LoadInterleaved3(f, points, px, py, pz);
  hn::StoreU(px, f, to.x + to.n);
  hn::StoreU(py, f, to.y + to.n);
  hn::StoreU(pz, f, to.z + to.n);
  const auto range = hn::Sqrt(hn::Add(hn::Add(hn::Mul(px, px), hn::Mul(py, py)), hn::Mul(pz, pz)));
  hn::StoreU(range, f, to.range + to.n);
  const auto far = hn::PromoteTo(d, range);  // NaN and infinity are not within the limits
  auto kept = hn::And(hn::Ge(far, hn::Set(d, limits.nearest)), hn::Le(far, hn::Set(d, limits.farthest)));
  // octomath's order of operations
  const auto au = hn::Sub(hn::Sub(hn::Mul(hn::Neg(x), px), hn::Mul(y, py)), hn::Mul(z, pz));
  const auto ax = hn::Add(hn::Sub(hn::Mul(y, pz), hn::Mul(py, z)), hn::Mul(u, px));
  const auto ay = hn::Add(hn::Sub(hn::Mul(z, px), hn::Mul(pz, x)), hn::Mul(u, py));
  const auto az = hn::Add(hn::Sub(hn::Mul(x, py), hn::Mul(px, y)), hn::Mul(u, pz));
  const auto turned = [&](VF b, VF ic, VF ib, VF c, VF ia, VF a) HWY_ATTR {  // b ic - ib c + au ia + iu a
    return hn::Add(hn::Add(hn::Sub(hn::Mul(b, ic), hn::Mul(ib, c)), hn::Mul(au, ia)), hn::Mul(iu, a));
  };
  const auto kx = keysOf(hn::Add(turned(ay, iz, iy, az, ix, ax), all(pose.t[0])), cells_per_metre, kept);
  const auto ky = keysOf(hn::Add(turned(az, ix, iz, ax, iy, ay), all(pose.t[1])), cells_per_metre, kept);
  const auto kz = keysOf(hn::Add(turned(ax, iy, ix, ay, iz, az), all(pose.t[2])), cells_per_metre, kept);
  hn::StoreU(cellsOf(kx, ky, kz), U(), to.cell + to.n);
  return kept;
}

/// `points`: x, y, z of each. The lists have room for as many, and for the lanes of a vector.
void LocatePoints(const Transform& pose, double cells_per_metre, const RangeLimits& limits, const float* points,
                  std::size_t n, LocatedPoints& to) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  const auto keep = [&](hn::Mask<D> kept, std::size_t count) HWY_ATTR {
    if (hn::AllTrue(d, kept) && count == lanes) {
      to.n += count;
      return;
    }
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, kept, bits);
    for (std::size_t i = 0, from = to.n; i < count; ++i, ++from) {
      if ((bits[i / 8] >> i % 8 & 1) == 0) continue;
      to.x[to.n] = to.x[from], to.y[to.n] = to.y[from], to.z[to.n] = to.z[from];
      to.range[to.n] = to.range[from];
      to.cell[to.n] = to.cell[from];
      ++to.n;
    }
  };
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) keep(locate(pose, cells_per_metre, limits, points + 3 * k, to), lanes);
  if (k == n) return;
  float rest[3 * kMostLanes] = {};
  std::copy(points + 3 * k, points + 3 * n, rest);
  keep(locate(pose, cells_per_metre, limits, rest, to), n - k);
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {

HWY_EXPORT(LocatePoints);

static_assert(sizeof(octomap::point3d) == 3 * sizeof(float));

void locatePoints(const KeySpace& keys, const octomap::Pointcloud& points, const octomap::pose6d& pose,
                  double min_range, double max_range, ScanPoints& scan) {
  const std::size_t n = points.size(), room = n + kMostLanes;
  for (std::vector<float>* v : {&scan.x, &scan.y, &scan.z, &scan.range}) v->resize(room);
  scan.cell.resize(room);
  LocatedPoints to{.x = scan.x.data(),
                   .y = scan.y.data(),
                   .z = scan.z.data(),
                   .range = scan.range.data(),
                   .cell = scan.cell.data(),
                   .n = 0};
  const RangeLimits limits{
      .nearest = static_cast<float>(min_range),
      .farthest = max_range < 0 ? std::numeric_limits<float>::max() : static_cast<float>(max_range)};
  const float* first = n == 0 ? nullptr : &points.begin()->x();
  HWY_DYNAMIC_DISPATCH(LocatePoints)(Transform(pose), keys.inverseResolution(), limits, first, n, to);
  for (std::vector<float>* v : {&scan.x, &scan.y, &scan.z, &scan.range}) v->resize(to.n);
  scan.cell.resize(to.n);
  scan.given = n;
  scan.dropped = n - to.n;
}

}  // namespace rhmap
#endif
