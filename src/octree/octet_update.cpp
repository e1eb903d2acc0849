// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/octet_update.hpp"

#include <cfloat>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "octet_update.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, 8>;
using VF = hn::Vec<F>;
using MF = hn::Mask<F>;

/// Lanes i, i + 1, ... whose bits are set.
HWY_INLINE MF lanesOf(unsigned bits, std::size_t i) {
  const std::uint8_t from_here[8] = {static_cast<std::uint8_t>(bits >> i)};
  return hn::LoadMaskBits(F(), from_here);
}

HWY_INLINE unsigned bitsOf(MF lanes, std::size_t i) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(F(), lanes, bits);
  return unsigned{bits[0]} << i;
}

/// Of two values the larger; the first of equal ones (0 and -0).
HWY_INLINE VF larger(VF first, VF second) { return hn::IfThenElse(hn::Gt(second, first), second, first); }

/// The largest of all lanes, of equal ones the first: each with the next, pairs with the next pair, and so on.
HWY_INLINE float largest(VF v) {
#if HWY_TARGET != HWY_SCALAR
  v = larger(v, hn::Shuffle2301(v));
  v = larger(v, hn::Shuffle1032(v));
  if (hn::Lanes(F()) > 4) v = larger(v, hn::SwapAdjacentBlocks(v));
#endif
  return hn::GetLane(v);
}

/// SensorModel::settled for hits and for misses: what a value must reach, and what it must not exceed; NaN, which none
/// does, where an update has no such limit.
struct SettledAt {
  explicit SettledAt(const SensorModel& model)
      : hit_from(model.hit >= 0 ? model.clamp_max : NAN),
        hit_to(model.hit <= 0 ? model.clamp_min : NAN),
        miss_from(model.miss >= 0 ? model.clamp_max : NAN),
        miss_to(model.miss <= 0 ? model.clamp_min : NAN) {}
  float hit_from, hit_to, miss_from, miss_to;
};

HWY_INLINE void updateOctet(OctetUpdate<OcTreeNode>& o, const SensorModel& model, const SettledAt& settled_at) {
  const F f;
  static_assert(sizeof(OcTreeNode) == sizeof(float));
  float* values = reinterpret_cast<float*>(o.cells);
  const VF low = hn::Set(f, model.clamp_min), high = hn::Set(f, model.clamp_max), least = hn::Set(f, -FLT_MAX);
  unsigned changed = 0;
  bool uniform = o.after == 0xff;
  float max = -FLT_MAX;
  VF first = hn::Zero(f);
  for (std::size_t i = 0; i < 8; i += hn::Lanes(f)) {
    const MF hit = lanesOf(o.hit, i);
    const MF existing = lanesOf(o.existing, i);
    const auto chosen = [&](float of_hit, float of_miss)
                            HWY_ATTR { return hn::IfThenElse(hit, hn::Set(f, of_hit), hn::Set(f, of_miss)); };
    const VF before = hn::IfThenElse(existing, hn::LoadU(f, values + i), hn::Set(f, o.start));
    const MF settled = hn::Or(hn::Ge(before, chosen(settled_at.hit_from, settled_at.miss_from)),
                              hn::Le(before, chosen(settled_at.hit_to, settled_at.miss_to)));
    const MF change = hn::AndNot(hn::And(existing, settled), lanesOf(unsigned{o.hit} | o.free, i));
    const VF sum = hn::Add(before, chosen(model.hit, model.miss));
    const VF clamped = hn::IfThenElse(hn::Lt(sum, low), low, hn::IfThenElse(hn::Gt(sum, high), high, sum));
    const VF value = hn::IfThenElse(change, clamped, before);
    hn::StoreU(value, f, values + i);
    // As OcTreeNode::maxLogOdds finds it: the least where there is none or NaN.
    const float most = largest(hn::IfThenElse(hn::And(lanesOf(o.after, i), hn::Gt(value, least)), value, least));
    if (most > max) max = most;
    if (i == 0) first = hn::Set(f, hn::GetLane(value));
    uniform = uniform && hn::AllTrue(f, hn::Eq(value, first));
    changed |= bitsOf(change, i);
  }
  o.changed = static_cast<std::uint8_t>(changed);
  o.uniform = uniform;
  if (changed != 0 && o.parent != nullptr) o.parent->setLogOdds(uniform ? hn::GetLane(first) : max);
}

void UpdateOctets(OctetUpdate<OcTreeNode>* octets, std::size_t count, const SensorModel& model) {
  const SettledAt settled_at(model);
  for (std::size_t i = 0; i < count; ++i) updateOctet(octets[i], model, settled_at);
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
