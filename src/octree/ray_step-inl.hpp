// SPDX-License-Identifier: BSD-3-Clause
// For files that Highway compiles once for every instruction set; hence no #pragma once.
#if defined(RHMAP_RAY_STEP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RHMAP_RAY_STEP_INL
#undef RHMAP_RAY_STEP_INL
#else
#define RHMAP_RAY_STEP_INL
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "rhmap/core/cell_word.hpp"

HWY_BEFORE_NAMESPACE();
namespace rhmap::HWY_NAMESPACE {

/// One step of rays, one a lane: Ray::advance(Ray::nextAxis()) without branches, because the next axis of a ray is hard
/// to guess. Cells are mirrored (see RayBatch), so that all steps go upwards. Returns the next cells.
template <class F, class VF = hwy::HWY_NAMESPACE::Vec<F>,
          class VU = hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::RebindToUnsigned<F>>>
HWY_INLINE VU advance(F /*f*/, VF& tx, VF& ty, VF& tz, VF dx, VF dy, VF dz, VU cell) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToUnsigned<F> u;
  const auto x_before_y = hn::Lt(tx, ty);
  const auto z = hn::Le(tz, hn::Min(tx, ty));
  // All sums and the choice between x and y are there before it is known whether it is z: a ray waits for its last
  // step.
  const VF tx_next = hn::Add(tx, dx), ty_next = hn::Add(ty, dy), tz_next = hn::Add(tz, dz);
  tx = hn::IfThenElse(z, tx, hn::IfThenElse(x_before_y, tx_next, tx));
  ty = hn::IfThenElse(z, ty, hn::IfThenElse(x_before_y, ty, ty_next));
  tz = hn::IfThenElse(z, tz_next, tz);

  const VU others =  // the bits of the axes that stay
      hn::IfThenElse(hn::RebindMask(u, z), hn::Set(u, ~cell_word::kAxis[2]),
                     hn::IfThenElse(hn::RebindMask(u, x_before_y), hn::Set(u, ~cell_word::kAxis[0]),
                                    hn::Set(u, ~cell_word::kAxis[1])));
  const VU up = hn::Add(hn::Or(cell, others), hn::Set(u, 1));  // the carry runs through the others' bits
  return hn::Or(hn::And(others, cell), hn::AndNot(others, up));
}

}  // namespace rhmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
