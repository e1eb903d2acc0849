// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace rhmap {

inline constexpr float kPi = 3.14159265358979323846F;

/// atan(a) / a by powers of a^2, from the highest on: Abramowitz & Stegun 4.4.49.
inline constexpr float kAtan[] = {0.0208351F, -0.0851330F, 0.1801410F, -0.3302995F, 0.9998660F};

/// atan2, to 1.2e-5 rad: the same on every machine, without branches, so that loops over it become vector code.
inline float fastAtan2(float y, float x) {
  const float ax = std::fabs(x), ay = std::fabs(y);
  const float larger = ax > ay ? ax : ay, smaller = ax > ay ? ay : ax;
  const float a = smaller / (larger + 1e-30F);
  const float s = a * a;
  float r = a * (kAtan[4] + s * (kAtan[3] + s * (kAtan[2] + s * (kAtan[1] + s * kAtan[0]))));
  r = ay > ax ? kPi / 2 - r : r;
  r = x < 0 ? kPi - r : r;
  return y < 0 ? -r : r;
}

}  // namespace rhmap
