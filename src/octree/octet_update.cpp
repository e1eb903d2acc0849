// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/octet_update.hpp"

#include <cfloat>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "octet_update.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, 8>;
using U = hn::RebindToUnsigned<F>;
using VF = hn::Vec<F>;
using MF = hn::Mask<F>;

/// Lanes i, i + 1, ... whose bits are set.
HWY_INLINE MF lanesOf(unsigned bits, std::size_t i) {
  const U u;
  const auto lane_bit = hn::Shl(hn::Set(u, 1), hn::Iota(u, static_cast<std::uint32_t>(i)));
  return hn::RebindMask(F(), hn::Ne(hn::And(hn::Set(u, bits), lane_bit), hn::Zero(u)));
}

HWY_INLINE unsigned bitsOf(MF lanes, std::size_t i) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(F(), lanes, bits);
  return unsigned{bits[0]} << i;
}

/// Of two values the larger; the first of equal ones (0 and -0).
HWY_INLINE float larger(float first, float second) { return second > first ? second : first; }

HWY_INLINE void updateOctet(OctetUpdate<OcTreeNode>& o, const SensorModel& model) {
  const F f;
  static_assert(sizeof(OcTreeNode) == sizeof(float));
  float* values = reinterpret_cast<float*>(o.cells);
  const VF low = hn::Set(f, model.clamp_min);
  const VF high = hn::Set(f, model.clamp_max);
  // SensorModel::settled, for hits and for misses.
  const MF always = hn::Eq(low, low);
  const MF never = hn::Not(always);
  const auto settled = [&](VF value, float update) HWY_ATTR {
    return hn::Or(hn::And(update >= 0 ? always : never, hn::Ge(value, high)),
                  hn::And(update <= 0 ? always : never, hn::Le(value, low)));
  };

  HWY_ALIGN float present[8];  // the values, and the least where there is none or NaN
  unsigned changed = 0;
  bool uniform = true;
  VF first = hn::Zero(f);
  for (std::size_t i = 0; i < 8; i += hn::Lanes(f)) {
    const MF hit = lanesOf(o.hit, i);
    const MF existing = lanesOf(o.existing, i);
    const VF before = hn::IfThenElse(existing, hn::LoadU(f, values + i), hn::Set(f, o.start));
    const MF abort = hn::And(
        existing, hn::Or(hn::And(hit, settled(before, model.hit)), hn::AndNot(hit, settled(before, model.miss))));
    const MF change = hn::AndNot(abort, lanesOf(unsigned{o.hit} | o.free, i));
    const VF sum = hn::Add(before, hn::IfThenElse(hit, hn::Set(f, model.hit), hn::Set(f, model.miss)));
    const VF clamped = hn::IfThenElse(hn::Lt(sum, low), low, hn::IfThenElse(hn::Gt(sum, high), high, sum));
    const VF value = hn::IfThenElse(change, clamped, before);
    hn::StoreU(value, f, values + i);
    const VF least = hn::Set(f, -FLT_MAX);
    hn::Store(hn::IfThenElse(hn::And(lanesOf(o.after, i), hn::Gt(value, least)), value, least), f, present + i);
    if (i == 0) first = hn::Set(f, hn::GetLane(value));
    uniform = uniform && hn::AllTrue(f, hn::Eq(value, first));
    changed |= bitsOf(change, i);
  }
  o.changed = static_cast<std::uint8_t>(changed);
  o.uniform = uniform && o.after == 0xff;
  o.max = larger(larger(larger(present[0], present[1]), larger(present[2], present[3])),
                 larger(larger(present[4], present[5]), larger(present[6], present[7])));
}

void UpdateOctets(OctetUpdate<OcTreeNode>* octets, std::size_t count, const SensorModel& model) {
  for (std::size_t i = 0; i < count; ++i) updateOctet(octets[i], model);
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {

HWY_EXPORT(UpdateOctets);

void updateOctets(std::span<OctetUpdate<OcTreeNode>> octets, const SensorModel& model) {
  HWY_DYNAMIC_DISPATCH(UpdateOctets)(octets.data(), octets.size(), model);
}

}  // namespace rhmap
#endif
