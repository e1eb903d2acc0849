// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/ray_walk.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ray_walk.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<double>;
using U = hn::RebindToUnsigned<F>;
using VF = hn::Vec<F>;
using VU = hn::Vec<U>;
using MF = hn::Mask<F>;

/// What a lane has marked in one octant, on its way to the masks.
struct Marks {
  static constexpr std::size_t kCapacity = 2048;
  alignas(64) std::uint64_t octant[kCapacity];
  alignas(64) std::uint64_t bits[kCapacity];
  std::size_t size = 0;

  void flush(ScanMasks& masks) {
    for (std::size_t i = 0; i < size; ++i) masks.markFree(octant[i], bits[i]);
    size = 0;
  }
};

/// One ray a lane. A lane collects the cells of one octant in `marked` and hands them on when it leaves the octant.
struct Lanes {
  VF t_max[3], t_delta[3], length;
  VU step[3], cell, end, marked;
};

/// The same as arrays, to put another ray into a lane.
struct LaneArrays {
  static constexpr std::size_t kLanes = HWY_MAX_BYTES / sizeof(double);
  alignas(64) double t_max[3][kLanes];
  alignas(64) double t_delta[3][kLanes];
  alignas(64) double length[kLanes];
  alignas(64) std::uint64_t step[3][kLanes];
  alignas(64) std::uint64_t cell[kLanes];
  alignas(64) std::uint64_t end[kLanes];
  alignas(64) std::uint64_t marked[kLanes];

  void put(std::size_t lane, const RayBatch& rays, std::size_t ray) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      t_max[axis][lane] = rays.t_max[axis][ray];
      t_delta[axis][lane] = rays.t_delta[axis][ray];
      step[axis][lane] = rays.step[axis][ray];
    }
    length[lane] = rays.length[ray];
    cell[lane] = rays.cell[ray];
    end[lane] = rays.end[ray];
    marked[lane] = std::uint64_t{1} << (rays.cell[ray] & 63);
  }

  Lanes load() const {
    const F f;
    const U u;
    Lanes lanes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lanes.t_max[axis] = hn::Load(f, t_max[axis]);
      lanes.t_delta[axis] = hn::Load(f, t_delta[axis]);
      lanes.step[axis] = hn::Load(u, step[axis]);
    }
    lanes.length = hn::Load(f, length);
    lanes.cell = hn::Load(u, cell);
    lanes.end = hn::Load(u, end);
    lanes.marked = hn::Load(u, marked);
    return lanes;
  }

  /// Only what changes while a ray is walked.
  void store(const Lanes& lanes) {
    for (std::size_t axis = 0; axis < 3; ++axis) hn::Store(lanes.t_max[axis], F(), t_max[axis]);
    hn::Store(lanes.cell, U(), cell);
    hn::Store(lanes.marked, U(), marked);
  }

  /// Walks the ray of one lane to its end, without vectors.
  void finish(std::size_t lane, ScanMasks& masks) {
    Ray ray{{t_max[0][lane], t_max[1][lane], t_max[2][lane]},
            {t_delta[0][lane], t_delta[1][lane], t_delta[2][lane]},
            {},
            {}};
    std::uint64_t at = cell[lane];
    std::uint64_t bits = marked[lane];
    for (;;) {
      const int axis = ray.nextAxis();
      ray.t_max[axis] += ray.t_delta[axis];
      const std::uint64_t next = cell_word::advance(at, cell_word::kAxis[axis], step[axis][lane]);
      const bool done = next == end[lane] || ray.exitDistance() > length[lane];
      if (done || (next ^ at) >> 6 != 0) {
        masks.markFree(at >> 6, bits);
        bits = 0;
      }
      if (done) return;
      at = next;
      bits |= std::uint64_t{1} << (at & 63);
    }
  }
};

/// One step of every lane, forEachRayKey's arithmetic. Returns the lanes whose ray has ended.
HWY_INLINE MF stepAll(Lanes& l, Marks& marks) {
  const F f;
  const U u;
  const MF x_before_y = hn::Lt(l.t_max[0], l.t_max[1]);
  const MF x = hn::And(x_before_y, hn::Lt(l.t_max[0], l.t_max[2]));
  const MF y = hn::AndNot(x_before_y, hn::Lt(l.t_max[1], l.t_max[2]));
  const MF z = hn::Not(hn::Or(x, y));
  l.t_max[0] = hn::IfThenElse(x, hn::Add(l.t_max[0], l.t_delta[0]), l.t_max[0]);
  l.t_max[1] = hn::IfThenElse(y, hn::Add(l.t_max[1], l.t_delta[1]), l.t_max[1]);
  l.t_max[2] = hn::IfThenElse(z, hn::Add(l.t_max[2], l.t_delta[2]), l.t_max[2]);

  const auto xu = hn::RebindMask(u, x);
  const auto yu = hn::RebindMask(u, y);
  const VU axis = hn::IfThenElse(xu, hn::Set(u, cell_word::kAxis[0]),
                                 hn::IfThenElse(yu, hn::Set(u, cell_word::kAxis[1]), hn::Set(u, cell_word::kAxis[2])));
  const VU step = hn::IfThenElse(xu, l.step[0], hn::IfThenElse(yu, l.step[1], l.step[2]));
  const VU moved = hn::And(hn::Add(hn::Or(l.cell, hn::Not(axis)), step), axis);
  const VU next = hn::Or(moved, hn::AndNot(axis, l.cell));

  const VF exit = hn::Min(hn::Min(l.t_max[0], l.t_max[1]), l.t_max[2]);
  const MF done = hn::Or(hn::RebindMask(f, hn::Eq(next, l.end)), hn::Gt(exit, l.length));
  const auto left = hn::Or(hn::RebindMask(u, done), hn::Ne(hn::ShiftRight<6>(hn::Xor(next, l.cell)), hn::Zero(u)));

  hn::CompressStore(hn::ShiftRight<6>(l.cell), left, u, marks.octant + marks.size);
  marks.size += hn::CompressStore(l.marked, left, u, marks.bits + marks.size);
  const VU bit = hn::Shl(hn::Set(u, 1), hn::And(next, hn::Set(u, 63)));
  l.marked = hn::Or(hn::IfThenZeroElse(left, l.marked), bit);
  l.cell = next;
  return done;
}

void WalkRays(const RayBatch& rays, ScanMasks& masks) {
  const F f;
  const std::size_t width = hn::Lanes(f);
  LaneArrays arrays;
  std::size_t busy = std::min(width, rays.size());
  for (std::size_t lane = 0; lane < busy; ++lane) arrays.put(lane, rays, lane);
  if (busy == width) {
    Marks marks;
    Lanes lanes = arrays.load();
    for (std::size_t next_ray = width;;) {
      const MF done = stepAll(lanes, marks);
      if (marks.size > Marks::kCapacity - 2 * LaneArrays::kLanes) marks.flush(masks);
      if (HWY_LIKELY(hn::AllFalse(f, done))) continue;
      arrays.store(lanes);
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(f, done, bits);
      for (unsigned ended = bits[0]; ended != 0; ended &= ended - 1) {
        const auto lane = static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(ended));
        if (next_ray < rays.size()) {
          arrays.put(lane, rays, next_ray++);
        } else {
          arrays.end[lane] = arrays.cell[lane];  // nothing left for this lane
          --busy;
        }
      }
      if (busy < width) break;
      lanes = arrays.load();
    }
    marks.flush(masks);
    for (std::size_t lane = 0; lane < width; ++lane)
      if (arrays.end[lane] != arrays.cell[lane]) arrays.finish(lane, masks);
  } else {
    for (std::size_t lane = 0; lane < busy; ++lane) arrays.finish(lane, masks);
  }
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {

HWY_EXPORT(WalkRays);

void walkRays(const RayBatch& rays, ScanMasks& masks) { HWY_DYNAMIC_DISPATCH(WalkRays)(rays, masks); }

}  // namespace rhmap
#endif
