// SPDX-License-Identifier: BSD-3-Clause
#include "tally.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tally.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for every instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using U8 = hn::CappedTag<std::uint8_t, 64>;

/// Bit i is lane i.
HWY_INLINE hn::Mask<U8> lanesOf(std::uint64_t cubes) {
  std::uint8_t bits[8];
  for (std::size_t byte = 0; byte < 8; ++byte) bits[byte] = static_cast<std::uint8_t>(cubes >> 8 * byte);
  return hn::LoadMaskBits(U8(), bits);
}

HWY_INLINE std::uint64_t cubesOf(hn::Mask<U8> lanes) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(U8(), lanes, bits);
  std::uint64_t cubes = 0;
  for (std::size_t byte = 0; byte < 8; ++byte) cubes |= std::uint64_t{bits[byte]} << 8 * byte;
  return cubes;
}

std::uint64_t CountUp(std::uint8_t* tally, std::uint64_t cubes, std::uint8_t enough) {
  const U8 d;
  std::uint64_t reached = 0;
  for (std::size_t i = 0; i < 64; i += hn::Lanes(d)) {
    const auto counted = lanesOf(cubes >> i);
    const auto after = hn::SaturatedAdd(hn::LoadU(d, tally + i), hn::IfThenElseZero(counted, hn::Set(d, 1)));
    hn::StoreU(after, d, tally + i);
    reached |= cubesOf(hn::And(counted, hn::Eq(hn::Max(after, hn::Set(d, enough)), after))) << i;
  }
  return reached;
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhmap {

HWY_EXPORT(CountUp);

std::uint64_t countUp(Tally& tally, std::uint64_t cubes, int enough) {
  return HWY_DYNAMIC_DISPATCH(CountUp)(tally.data(), cubes, static_cast<std::uint8_t>(enough));
}

}  // namespace rhmap
#endif
