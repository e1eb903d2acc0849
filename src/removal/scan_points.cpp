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

/// What is known of a few points.
struct LocatedPoints {
  static constexpr std::size_t kMost = 64;
  alignas(64) float x[kMost], y[kMost], z[kMost], range[kMost];
  alignas(64) std::int32_t key[3][kMost];  ///< outside of the tree: below 0
};

}  // namespace rhmap
#endif

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using F = hn::Rebind<float, D>;
using I = hn::Rebind<std::int32_t, D>;
using VF = hn::Vec<F>;

HWY_INLINE void storeKeys(VF world, double cells_per_metre, std::int32_t* keys) {
  const D d;
  const auto cell = hn::Floor(hn::Mul(hn::Set(d, cells_per_metre), hn::PromoteTo(d, world)));
  const auto half = hn::Set(d, double(kTreeMaxVal));
  const auto inside = hn::And(hn::Ge(cell, hn::Neg(half)), hn::Lt(cell, half));  // NaN is not
  hn::Store(hn::DemoteTo(I(), hn::IfThenElse(inside, hn::Add(cell, half), hn::Set(d, -1))), I(), keys);
}

/// A multiple of the lanes. `points`: x, y, z of each. In octomath's order of operations.
void LocateSome(const Transform& pose, double cells_per_metre, const float* points, std::size_t n, LocatedPoints& to) {
  const F f;
  const auto all = [f](float value) HWY_ATTR { return hn::Set(f, value); };
  const auto u = all(pose.u), x = all(pose.x), y = all(pose.y), z = all(pose.z);
  const auto iu = all(pose.iu), ix = all(pose.ix), iy = all(pose.iy), iz = all(pose.iz);
  for (std::size_t k = 0; k < n; k += hn::Lanes(f)) {
    VF px, py, pz;
    hn::LoadInterleaved3(f, points + 3 * k, px, py, pz);
    hn::Store(px, f, to.x + k);
    hn::Store(py, f, to.y + k);
    hn::Store(pz, f, to.z + k);
    const auto squared = hn::Add(hn::Add(hn::Mul(px, px), hn::Mul(py, py)), hn::Mul(pz, pz));
    hn::Store(hn::Sqrt(squared), f, to.range + k);
    const auto au = hn::Sub(hn::Sub(hn::Mul(hn::Neg(x), px), hn::Mul(y, py)), hn::Mul(z, pz));
    const auto ax = hn::Add(hn::Sub(hn::Mul(y, pz), hn::Mul(py, z)), hn::Mul(u, px));
    const auto ay = hn::Add(hn::Sub(hn::Mul(z, px), hn::Mul(pz, x)), hn::Mul(u, py));
    const auto az = hn::Add(hn::Sub(hn::Mul(x, py), hn::Mul(px, y)), hn::Mul(u, pz));
    const auto turned = [&](VF b, VF ic, VF ib, VF c, VF ia, VF a) HWY_ATTR {  // b ic - ib c + au ia + iu a
      return hn::Add(hn::Add(hn::Sub(hn::Mul(b, ic), hn::Mul(ib, c)), hn::Mul(au, ia)), hn::Mul(iu, a));
    };
    storeKeys(hn::Add(turned(ay, iz, iy, az, ix, ax), all(pose.t[0])), cells_per_metre, to.key[0] + k);
    storeKeys(hn::Add(turned(az, ix, iz, ax, iy, ay), all(pose.t[1])), cells_per_metre, to.key[1] + k);
    storeKeys(hn::Add(turned(ax, iy, ix, ay, iz, az), all(pose.t[2])), cells_per_metre, to.key[2] + k);
  }
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {

HWY_EXPORT(LocateSome);

void locatePoints(const KeySpace& keys, const octomap::Pointcloud& points, const octomap::pose6d& pose,
                  double min_range, double max_range, ScanPoints& scan) {
  constexpr std::size_t kMost = LocatedPoints::kMost;
  const std::size_t n = points.size();
  for (std::vector<float>* v : {&scan.x, &scan.y, &scan.z, &scan.range}) v->resize(n);
  scan.cube.resize(n);
  const Transform transform(pose);
  const auto nearest = static_cast<float>(min_range);
  const float farthest = max_range < 0 ? std::numeric_limits<float>::max() : static_cast<float>(max_range);
  LocatedPoints some;
  float given[3 * kMost] = {};
  std::size_t k = 0;
  for (std::size_t first = 0; first < n; first += kMost) {
    const std::size_t count = std::min(kMost, n - first);
    for (std::size_t i = 0; i < count; ++i) {
      const octomap::point3d& p = points[static_cast<unsigned>(first + i)];
      given[3 * i] = p.x(), given[3 * i + 1] = p.y(), given[3 * i + 2] = p.z();
    }
    HWY_DYNAMIC_DISPATCH(LocateSome)(transform, keys.inverseResolution(), given, kMost, some);
    for (std::size_t i = 0; i < count; ++i) {
      const float range = some.range[i];
      if (!(range >= nearest && range <= farthest)) continue;  // NaN and infinity, too
      if ((some.key[0][i] | some.key[1][i] | some.key[2][i]) < 0) continue;
      scan.x[k] = some.x[i], scan.y[k] = some.y[i], scan.z[k] = some.z[i], scan.range[k] = range;
      scan.cube[k] = {static_cast<key_type>(some.key[0][i]), static_cast<key_type>(some.key[1][i]),
                      static_cast<key_type>(some.key[2][i])};
      ++k;
    }
  }
  for (std::vector<float>* v : {&scan.x, &scan.y, &scan.z, &scan.range}) v->resize(k);
  scan.cube.resize(k);
  scan.given = n;
  scan.dropped = n - k;
}

}  // namespace rhmap
#endif
