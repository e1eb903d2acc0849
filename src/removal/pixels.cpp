// SPDX-License-Identifier: BSD-3-Clause
#include "pixels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pixels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

#include <algorithm>

#include "range_image.hpp"

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;

/// fastAtan2, operation by operation.
HWY_INLINE VF atan2(VF y, VF x) {
  const F f;
  const auto ax = hn::Abs(x), ay = hn::Abs(y);
  const auto larger = hn::IfThenElse(hn::Gt(ax, ay), ax, ay), smaller = hn::IfThenElse(hn::Gt(ax, ay), ay, ax);
  const auto a = hn::Div(smaller, hn::Add(larger, hn::Set(f, 1e-30F)));
  const auto s = hn::Mul(a, a);
  auto r = hn::Set(f, kAtan[0]);
  for (std::size_t i = 1; i < std::size(kAtan); ++i) r = hn::Add(hn::Set(f, kAtan[i]), hn::Mul(s, r));
  r = hn::Mul(a, r);
  r = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(hn::Set(f, kPi / 2), r), r);
  r = hn::IfThenElse(hn::Lt(x, hn::Zero(f)), hn::Sub(hn::Set(f, kPi), r), r);
  return hn::IfThenElse(hn::Lt(y, hn::Zero(f)), hn::Neg(r), r);
}

HWY_INLINE void pixelsOfLanes(const Projection& projection, const float* HWY_RESTRICT x, const float* HWY_RESTRICT y,
                              const float* HWY_RESTRICT z, std::int32_t* HWY_RESTRICT pixels,
                              float* HWY_RESTRICT ranges) {
  const F f;
  const I i;
  const auto vx = hn::LoadU(f, x), vy = hn::LoadU(f, y), vz = hn::LoadU(f, z);
  const auto squared = hn::Add(hn::Mul(vx, vx), hn::Mul(vy, vy));
  if (ranges != nullptr) hn::StoreU(hn::Sqrt(hn::Add(squared, hn::Mul(vz, vz))), f, ranges);
  const auto level = hn::Sqrt(squared);
  const auto below = hn::Sub(hn::Set(f, projection.top), atan2(vz, level));
  const auto step = hn::Add(hn::Mul(below, hn::Set(f, projection.stepsPerRadian())), hn::Set(f, 0.5F));
  const auto turn = hn::Add(hn::Mul(atan2(vy, vx), hn::Set(f, 0.5F / kPi)), hn::Set(f, 0.5F));
  const auto columns = hn::Set(i, projection.columns);
  auto column = hn::ConvertTo(i, hn::Mul(turn, hn::Set(f, static_cast<float>(projection.columns))));
  column = hn::IfThenElse(hn::Lt(column, columns), column, hn::Sub(column, columns));
  const auto inside =
      hn::And(hn::Ge(step, hn::Zero(f)), hn::Lt(step, hn::Set(f, static_cast<float>(projection.steps()))));
  const auto row = hn::GatherIndex(i, projection.row.data(), hn::ConvertTo(i, hn::IfThenElseZero(inside, step)));
  const auto pixel = hn::Add(hn::Mul(row, columns), column);
  hn::StoreU(hn::IfThenElse(hn::RebindMask(i, inside), pixel, hn::Set(i, -1)), i, pixels);
}

void PixelsOf(const Projection& projection, const float* x, const float* y, const float* z, std::size_t n,
              std::int32_t* pixels, float* ranges) {
  const std::size_t lanes = hn::Lanes(F());
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes)
    pixelsOfLanes(projection, x + k, y + k, z + k, pixels + k, ranges == nullptr ? nullptr : ranges + k);
  if (k == n) return;
  constexpr std::size_t kMostLanes = HWY_MAX_BYTES / sizeof(float);
  float rest[3][kMostLanes] = {}, rest_ranges[kMostLanes];
  std::int32_t rest_pixels[kMostLanes];
  std::copy(x + k, x + n, rest[0]);
  std::copy(y + k, y + n, rest[1]);
  std::copy(z + k, z + n, rest[2]);
  pixelsOfLanes(projection, rest[0], rest[1], rest[2], rest_pixels, rest_ranges);
  std::copy(rest_pixels, rest_pixels + (n - k), pixels + k);
  if (ranges != nullptr) std::copy(rest_ranges, rest_ranges + (n - k), ranges + k);
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {

HWY_EXPORT(PixelsOf);

void pixelsOf(const Projection& projection, const float* x, const float* y, const float* z, std::size_t n,
              std::int32_t* pixels, float* ranges) {
  HWY_DYNAMIC_DISPATCH(PixelsOf)(projection, x, y, z, n, pixels, ranges);
}

}  // namespace rhmap
#endif
