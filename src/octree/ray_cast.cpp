// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/ray_cast.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "rhmap/octree/ray_steps.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ray_cast.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The three axes side by side, in as many vectors as it takes. A fourth has no steps.
using Q = hn::CappedTag<double, 4>;
using QU = hn::RebindToUnsigned<Q>;
using VQ = hn::Vec<Q>;
using VQU = hn::Vec<QU>;
constexpr std::size_t kWidth = hn::MaxLanes(Q());
constexpr std::size_t kParts = 4 / kWidth;

/// Where an axis begins in a cell word: in the region, and the region's.
struct Shifts {
  alignas(32) std::uint64_t in_region[4] = {0, 1, 2, 63};
  alignas(32) std::uint64_t of_region[4] = {9, 22, 35, 63};
};
constexpr Shifts kShifts;

/// cell_word::toKey(), an axis a lane.
HWY_INLINE VQU keyOf(VQU word, std::size_t part) {
  const QU u;
  const auto three = hn::And(hn::Shr(word, hn::Load(u, kShifts.in_region + part * kWidth)), hn::Set(u, 0b1001001));
  const auto region = hn::And(hn::Shr(word, hn::Load(u, kShifts.of_region + part * kWidth)), hn::Set(u, 0x1fff));
  const auto gathered = hn::Or(three, hn::Or(hn::ShiftRight<2>(three), hn::ShiftRight<4>(three)));
  return hn::Or(hn::ShiftLeft<3>(region), hn::And(gathered, hn::Set(u, 7)));
}

/// The bits that an axis has in cell_word::fromKey().
HWY_INLINE VQU wordOf(VQU key, std::size_t part) {
  const QU u;
  const auto three = hn::And(key, hn::Set(u, 7));
  const auto spread = hn::Or(three, hn::Or(hn::ShiftLeft<2>(three), hn::ShiftLeft<4>(three)));
  return hn::Or(hn::Shl(hn::And(spread, hn::Set(u, 0b1001001)), hn::Load(u, kShifts.in_region + part * kWidth)),
                hn::Shl(hn::ShiftRight<3>(key), hn::Load(u, kShifts.of_region + part * kWidth)));
}

// Small whole numbers there and back: they are the lowest bits of what is 2^52 larger.
constexpr double kWhole = 0x1p52;
HWY_INLINE VQ toDouble(VQU whole) {
  const Q q;
  return hn::Sub(hn::Or(hn::BitCast(q, whole), hn::Set(q, kWhole)), hn::Set(q, kWhole));
}
HWY_INLINE VQU toWhole(VQ whole) {
  const QU u;
  return hn::Xor(hn::BitCast(u, hn::Add(whole, hn::Set(Q(), kWhole))), hn::BitCast(u, hn::Set(Q(), kWhole)));
}

HWY_INLINE double smallest(const VQ (&parts)[kParts]) {
  VQ least = parts[0];
  for (std::size_t p = 1; p < kParts; ++p) least = hn::Min(least, parts[p]);
  return hn::GetLane(hn::MinOfLanes(Q(), least));
}

/// Steps of each axis by itself: their order does not matter as long as all of them come before the one that leaves the
/// cube; and those that come a cell and more before it certainly do.
HWY_INLINE void skipAhead(VQ (&t)[kParts], const VQ (&delta)[kParts], VQ (&left)[kParts], double limit) {
  const Q q;
  VQ whole[kParts], end[kParts];
  for (std::size_t p = 0; p < kParts; ++p) end[p] = hn::Add(t[p], hn::Mul(delta[p], hn::Sub(left[p], hn::Set(q, 1.0))));
  const VQ until = hn::Set(q, std::min(smallest(end), limit));
  double most = 0;
  for (std::size_t p = 0; p < kParts; ++p) {
    whole[p] = hn::Max(hn::Trunc(hn::Div(hn::Sub(until, t[p]), delta[p])), hn::Zero(q));
    left[p] = hn::Sub(left[p], whole[p]);
    most = std::max(most, hn::GetLane(hn::MaxOfLanes(q, whole[p])));
  }
  // Eight at a time: how many it will be is hard to guess.
  for (double first = 0; first < most; first += 8)
    for (int i = 0; i < 8; ++i)
      for (std::size_t p = 0; p < kParts; ++p)
        t[p] = hn::IfThenElse(hn::Lt(hn::Set(q, first + i), whole[p]), hn::Add(t[p], delta[p]), t[p]);
}

/// When each axis takes its next steps.
constexpr std::size_t kRows = 4;
using Rows = VQ[kRows][kParts];

/// The step that leaves a cube.
struct Exit {
  double distance;  ///< along the ray
  int axis;         ///< of axes that tie it is the last: the ray is outside before the others' turn
  bool is_in_rows;  ///< so are all steps before it
};

/// `left`: steps of each axis to the end of the cube.
HWY_INLINE Exit findExit(const Rows& row, const VQ (&left)[kParts]) {
  const Q q;
  VQ leaves[kParts];
  for (std::size_t p = 0; p < kParts; ++p) {
    leaves[p] = hn::Inf(q);
    for (std::size_t k = 0; k < kRows; ++k)
      leaves[p] = hn::IfThenElse(hn::Eq(left[p], hn::Set(q, double(k + 1))), row[k][p], leaves[p]);
  }
  Exit exit{.distance = smallest(leaves), .axis = 0, .is_in_rows = true};
  const VQ distance = hn::Set(q, exit.distance);
  std::uint64_t axes = 0;
  for (std::size_t p = 0; p < kParts; ++p) {
    std::uint8_t lanes[8] = {};
    hn::StoreMaskBits(q, hn::Eq(leaves[p], distance), lanes);
    axes |= std::uint64_t{lanes[0]} << p * kWidth;
    exit.is_in_rows = exit.is_in_rows && hn::AllTrue(q, hn::Ge(row[kRows - 1][p], distance));
  }
  exit.axis = 63 - static_cast<int>(hwy::Num0BitsAboveMS1Bit_Nonzero64(axes | 1));
  return exit;
}

/// leaveCube(), or the first of its steps: true if there are no more.
bool LeaveCube(RayCast& ray, int bits, double limit) {
  const Q q;
  const QU u;
  const std::uint64_t edge = std::uint64_t{1} << bits;
  VQU key[kParts];
  VQ t[kParts], delta[kParts], steps[kParts], left[kParts];  // steps to the end of the cube; those that are left
  for (std::size_t p = 0; p < kParts; ++p) {
    key[p] = keyOf(hn::Set(u, ray.mirrored), p);
    t[p] = hn::Load(q, ray.t_max.data() + p * kWidth);
    delta[p] = hn::Load(q, ray.t_delta.data() + p * kWidth);
    left[p] = steps[p] = toDouble(hn::Sub(hn::Set(u, edge), hn::And(key[p], hn::Set(u, edge - 1))));
  }
  if (bits > kRegionBits) skipAhead(t, delta, left, limit);

  Rows row;
  for (std::size_t k = 0; k < kRows; ++k)
    for (std::size_t p = 0; p < kParts; ++p) row[k][p] = k == 0 ? t[p] : hn::Add(row[k - 1][p], delta[p]);
  const Exit exit = findExit(row, left);
  const bool at_once = exit.is_in_rows && exit.distance <= limit;
  const VQ distance = hn::Set(q, exit.distance), axis = hn::Set(q, double(exit.axis)), last_key = hn::Set(q, 65535.0);
  ray.entry = exit.distance;
  ray.in_space = true;
  ray.mirrored = 0;
  for (std::size_t p = 0; p < kParts; ++p) {
    VQ taken = hn::Sub(steps[p], left[p]);
    if (at_once) {
      VQ more = hn::Zero(q);
      for (std::size_t k = 0; k + 1 < kRows; ++k) {
        const auto before = hn::Lt(row[k][p], distance);
        t[p] = hn::IfThenElse(before, row[k + 1][p], t[p]);
        more = hn::IfThenElse(before, hn::Set(q, double(k + 1)), more);
      }
      const auto then = hn::And(hn::Eq(t[p], distance), hn::Ge(hn::Iota(q, double(p * kWidth)), axis));
      t[p] = hn::IfThenElse(then, hn::Add(t[p], delta[p]), t[p]);
      taken = hn::Add(taken, hn::IfThenElse(then, hn::Add(more, hn::Set(q, 1.0)), more));
    }
    const VQ to = hn::Add(toDouble(key[p]), taken);
    ray.in_space = ray.in_space && hn::AllTrue(q, hn::Le(to, last_key));
    ray.mirrored |= hn::GetLane(hn::SumOfLanes(u, wordOf(toWhole(hn::Min(to, last_key)), p)));
    hn::Store(t[p], q, ray.t_max.data() + p * kWidth);
  }
  return at_once;
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {

HWY_EXPORT(LeaveCube);

namespace {

/// One step after the other, until the ray has left the cells that are the same in the bits `outside`.
void followUntil(RayCast& ray, std::uint64_t outside, double limit) {
  RaySteps now(ray);
  const std::uint64_t first = ray.mirrored;
  std::uint64_t before;
  double entry;
  do {
    before = now.mirrored();
    entry = now.exitDistance();
    now.take();
  } while (((now.mirrored() ^ first) & outside) == 0 && entry <= limit);
  now.store(ray);
  ray.entry = entry;
  ray.in_space = ray.mirrored > before;  // or else it has begun again at the other end
  if (!ray.in_space) ray.mirrored = before;
}

}  // namespace

void leaveCube(RayCast& ray, int bits, double limit) {
  if (!HWY_DYNAMIC_DISPATCH(LeaveCube)(ray, bits, limit)) followUntil(ray, cell_word::outsideOfCube(bits), limit);
}

void step(RayCast& ray) { followUntil(ray, 0, -std::numeric_limits<double>::infinity()); }

}  // namespace rhmap
#endif
