// SPDX-License-Identifier: BSD-3-Clause
// For files that Highway compiles once for every instruction set; hence no #pragma once.
#if defined(RHMAP_COMPRESS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RHMAP_COMPRESS_INL
#undef RHMAP_COMPRESS_INL
#else
#define RHMAP_COMPRESS_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX2
/// For each set of four lanes: its 32-bit halves side by side.
alignas(32) inline constexpr std::uint32_t kHalvesOf[16][8] = {
    {},
    {0, 1},
    {2, 3},
    {0, 1, 2, 3},
    {4, 5},
    {0, 1, 4, 5},
    {2, 3, 4, 5},
    {0, 1, 2, 3, 4, 5},
    {6, 7},
    {0, 1, 6, 7},
    {2, 3, 6, 7},
    {0, 1, 2, 3, 6, 7},
    {4, 5, 6, 7},
    {0, 1, 4, 5, 6, 7},
    {2, 3, 4, 5, 6, 7},
    {0, 1, 2, 3, 4, 5, 6, 7},
};
#endif

/// The chosen lanes of 64 bits side by side, from lane 0 on; the others hold anything.
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> compress(D d, hwy::HWY_NAMESPACE::Vec<D> v, hwy::HWY_NAMESPACE::Mask<D> which) {
  namespace hn = hwy::HWY_NAMESPACE;
  // Highway 1.0 looks this up in tables that GCC copies to the stack first, each time.
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  const hn::RebindToUnsigned<D> u;
  return hn::BitCast(
      d, hn::Vec<decltype(u)>{_mm512_maskz_compress_epi64(hn::RebindMask(u, which).raw, hn::BitCast(u, v).raw)});
#elif HWY_TARGET == HWY_AVX2
  const hn::RebindToUnsigned<D> u;
  const hn::Repartition<double, D> f;
  const int lanes = _mm256_movemask_pd(hn::BitCast(f, hn::VecFromMask(d, which)).raw);
  const __m256i order = _mm256_load_si256(reinterpret_cast<const __m256i*>(kHalvesOf[lanes]));
  return hn::BitCast(d, hn::Vec<decltype(u)>{_mm256_permutevar8x32_epi32(hn::BitCast(u, v).raw, order)});
#else
  (void)d;
  return hn::Compress(v, which);
#endif
}

/// Stores the chosen lanes side by side, and anything after them: in all as many as a vector has. (Compressing in
/// registers first, because compressing into memory takes a hundred cycles on some machines.)
template <class D, class T>
HWY_INLINE void storeCompressed(D d, hwy::HWY_NAMESPACE::Vec<D> v, hwy::HWY_NAMESPACE::Mask<D> which, T* to) {
  hwy::HWY_NAMESPACE::StoreU(compress(d, v, which), d, to);
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
