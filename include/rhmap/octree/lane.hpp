// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>

#ifdef __x86_64__  // and so it has SSE2
#include <emmintrin.h>
#endif

namespace rhmap {

/// A double, or all bits or none as the answer to a question about two. What follows from the answer is computed with
/// its bits: a jump would wait for it, and be wrong half of the time.
class PlainLane {
 public:
  explicit PlainLane(double value) : bits_(std::bit_cast<std::uint64_t>(value)) {}
  double value() const { return std::bit_cast<double>(bits_); }
  std::uint64_t bits() const { return bits_; }

  friend PlainLane operator+(PlainLane a, PlainLane b) { return PlainLane(a.value() + b.value()); }
  /// All bits if a < b.
  friend PlainLane less(PlainLane a, PlainLane b) { return ofBits(-std::uint64_t{a.value() < b.value()}); }
  friend PlainLane operator&(PlainLane a, PlainLane b) { return ofBits(a.bits_ & b.bits_); }
  friend PlainLane operator|(PlainLane a, PlainLane b) { return ofBits(a.bits_ | b.bits_); }
  /// The bits of a that b does not have.
  friend PlainLane without(PlainLane a, PlainLane b) { return ofBits(a.bits_ & ~b.bits_); }

 private:
  static PlainLane ofBits(std::uint64_t bits) {
    PlainLane lane(0.0);
    lane.bits_ = bits;  // not by way of a double: of these bits it might be a NaN, which some processors change
    return lane;
  }

  std::uint64_t bits_;
};

#ifdef __x86_64__
/// The same in a vector, where doubles are at home: a bit does not have to leave it.
class VectorLane {
 public:
  explicit VectorLane(double value) : v_(_mm_set1_pd(value)) {}
  double value() const { return _mm_cvtsd_f64(v_); }
  std::uint64_t bits() const { return static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm_castpd_si128(v_))); }

  friend VectorLane operator+(VectorLane a, VectorLane b) { return VectorLane(_mm_add_pd(a.v_, b.v_)); }
  friend VectorLane less(VectorLane a, VectorLane b) { return VectorLane(_mm_cmplt_pd(a.v_, b.v_)); }
  friend VectorLane operator&(VectorLane a, VectorLane b) { return VectorLane(_mm_and_pd(a.v_, b.v_)); }
  friend VectorLane operator|(VectorLane a, VectorLane b) { return VectorLane(_mm_or_pd(a.v_, b.v_)); }
  friend VectorLane without(VectorLane a, VectorLane b) { return VectorLane(_mm_andnot_pd(b.v_, a.v_)); }

 private:
  explicit VectorLane(__m128d v) : v_(v) {}

  __m128d v_;
};
using Lane = VectorLane;
#else
using Lane = PlainLane;
#endif

}  // namespace rhmap
