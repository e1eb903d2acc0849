// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/ray_walk.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ray_walk.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

#include "compress-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<double>;
using U = hn::RebindToUnsigned<F>;
using VF = hn::Vec<F>;
using VU = hn::Vec<U>;
using MF = hn::Mask<F>;
using MU = hn::Mask<U>;

constexpr std::size_t kMostLanes = HWY_MAX_BYTES / sizeof(double);
static_assert(kMostLanes <= RayBatch::kPad);

/// What the lanes have marked, each in one octant, on its way to the masks: any cell of the octant, and the bits of
/// those that were crossed.
struct Marks {
  static constexpr std::size_t kCapacity = 2048;
  alignas(64) std::uint64_t cell[kCapacity + 4 * kMostLanes];
  alignas(64) std::uint64_t bits[kCapacity + 4 * kMostLanes];
  std::size_t size = 0;

  void flush(ScanMasks& masks) {
    for (std::size_t i = 0; i < size; ++i) masks.markFree(cell[i] >> 6, bits[i]);
    size = 0;
  }
};

/// One ray a lane. A lane collects the cells of one octant in `marked` and hands them on when it leaves the octant.
/// Cells are mirrored (see RayBatch), so that all steps go upwards.
struct Lanes {
  VF tx, ty, tz, dx, dy, dz, length;
  VU mirror, cell, end, marked;
  MU busy;  ///< lanes with a ray
};

HWY_INLINE VU bitOf(VU cell) {
  const U u;
  return hn::Shl(hn::Set(u, 1), hn::And(cell, hn::Set(u, 63)));
}

/// Puts a ray of the batch into a lane.
HWY_INLINE void put(Lanes& l, std::size_t lane, const RayBatch& rays, std::size_t ray) {
  const F f;
  const U u;
  const MU here = hn::Eq(hn::Iota(u, 0), hn::Set(u, lane));
  const MF here_f = hn::RebindMask(f, here);
  // Other lanes get something from beside it, which is not looked at.
  const auto load = [&](const auto& column, auto tag)
                        HWY_ATTR { return hn::LoadU(tag, column.data() + RayBatch::kPad + ray - lane); };
  l.tx = hn::IfThenElse(here_f, load(rays.t_max[0], f), l.tx);
  l.ty = hn::IfThenElse(here_f, load(rays.t_max[1], f), l.ty);
  l.tz = hn::IfThenElse(here_f, load(rays.t_max[2], f), l.tz);
  l.dx = hn::IfThenElse(here_f, load(rays.t_delta[0], f), l.dx);
  l.dy = hn::IfThenElse(here_f, load(rays.t_delta[1], f), l.dy);
  l.dz = hn::IfThenElse(here_f, load(rays.t_delta[2], f), l.dz);
  l.length = hn::IfThenElse(here_f, load(rays.length, f), l.length);
  l.mirror = hn::IfThenElse(here, load(rays.mirror, u), l.mirror);
  l.cell = hn::IfThenElse(here, load(rays.cell, u), l.cell);
  l.end = hn::IfThenElse(here, load(rays.end, u), l.end);
  l.marked = hn::IfThenElse(here, bitOf(hn::Xor(l.cell, l.mirror)), l.marked);
  l.busy = hn::Or(l.busy, here);
}

/// Ray::advance(Ray::nextAxis()) in every lane, without branches. Returns the next cells.
HWY_INLINE VU advance(Lanes& l) {
  const U u;
  const MF x_before_y = hn::Lt(l.tx, l.ty);
  const MF z = hn::Le(l.tz, hn::Min(l.tx, l.ty));
  // All sums and the choice between x and y are there before it is known whether it is z: a ray waits for its last
  // step.
  const VF tx_next = hn::Add(l.tx, l.dx), ty_next = hn::Add(l.ty, l.dy), tz_next = hn::Add(l.tz, l.dz);
  l.tx = hn::IfThenElse(z, l.tx, hn::IfThenElse(x_before_y, tx_next, l.tx));
  l.ty = hn::IfThenElse(z, l.ty, hn::IfThenElse(x_before_y, l.ty, ty_next));
  l.tz = hn::IfThenElse(z, tz_next, l.tz);

  const VU others =  // the bits of the axes that stay
      hn::IfThenElse(hn::RebindMask(u, z), hn::Set(u, ~cell_word::kAxis[2]),
                     hn::IfThenElse(hn::RebindMask(u, x_before_y), hn::Set(u, ~cell_word::kAxis[0]),
                                    hn::Set(u, ~cell_word::kAxis[1])));
  const VU up = hn::Add(hn::Or(l.cell, others), hn::Set(u, 1));  // the carry runs through the others' bits
  return hn::Or(hn::And(others, l.cell), hn::AndNot(others, up));
}

/// One step of every lane, forEachRayKey's arithmetic. Returns the lanes whose ray has ended.
HWY_INLINE MU stepAll(Lanes& l, Marks& marks, std::size_t& size) {
  const U u;
  const VU next = advance(l);
  const VF exit = hn::Min(hn::Min(l.tx, l.ty), l.tz);
  const MU done = hn::And(hn::Or(hn::Eq(next, l.end), hn::RebindMask(u, hn::Gt(exit, l.length))), l.busy);
  const MU moved = hn::Ne(hn::And(hn::Xor(next, l.cell), hn::Set(u, ~std::uint64_t{63})), hn::Zero(u));
  const MU left = hn::And(hn::Or(done, moved), l.busy);

  storeCompressed(u, hn::Xor(l.cell, l.mirror), left, marks.cell + size);
  storeCompressed(u, l.marked, left, marks.bits + size);
  size += hn::CountTrue(u, left);
  l.marked = hn::Or(hn::IfThenZeroElse(left, l.marked), bitOf(hn::Xor(next, l.mirror)));
  l.cell = next;
  return done;
}

/// Gives the lanes whose ray has ended the next ones of the batch.
HWY_INLINE void refill(Lanes& l, MU done, const RayBatch& rays, std::size_t& next_ray) {
  const U u;
  l.busy = hn::AndNot(done, l.busy);
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(u, done, bits);
  for (unsigned ended = bits[0]; ended != 0 && next_ray < rays.size(); ended &= ended - 1)
    put(l, static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(ended)), rays, next_ray++);
}

/// Walks until all rays have ended (true) or there is no room for more marks. A function without calls, so that the
/// lanes stay in registers; two vectors at a time, because each step waits for the one before.
HWY_NOINLINE bool walk(Lanes (&lanes)[2], const RayBatch& rays, std::size_t& next_ray, Marks& marks) {
  const U u;
  Lanes a = lanes[0];
  Lanes b = lanes[1];
  std::size_t next = next_ray;
  std::size_t size = marks.size;
  bool busy = true;
  do {
    const MU done_a = stepAll(a, marks, size);
    const MU done_b = stepAll(b, marks, size);
    if (HWY_LIKELY(hn::AllFalse(u, hn::Or(done_a, done_b)))) continue;
    refill(a, done_a, rays, next);
    refill(b, done_b, rays, next);
    busy = !hn::AllFalse(u, hn::Or(a.busy, b.busy));
  } while (busy && size < Marks::kCapacity);
  lanes[0] = a;
  lanes[1] = b;
  next_ray = next;
  marks.size = size;
  return !busy;
}

void WalkRays(const RayBatch& rays, ScanMasks& masks) {
  const F f;
  const U u;
  Marks marks;
  const VF nowhere = hn::Zero(f);
  const VU none = hn::Zero(u);
  const MU idle = hn::FirstN(u, 0);
  Lanes lanes[2];
  for (Lanes& l : lanes)
    l = {nowhere, nowhere, nowhere, nowhere, nowhere, nowhere, nowhere, none, none, none, none, idle};
  std::size_t next_ray = 0;
  for (Lanes& l : lanes) refill(l, hn::FirstN(u, hn::Lanes(u)), rays, next_ray);
  if (next_ray == 0) return;
  while (!walk(lanes, rays, next_ray, marks)) marks.flush(masks);
  marks.flush(masks);
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {

HWY_EXPORT(WalkRays);

void walkRays(const RayBatch& rays, ScanMasks& masks) { HWY_DYNAMIC_DISPATCH(WalkRays)(rays, masks); }

}  // namespace rhmap
#endif
