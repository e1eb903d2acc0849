// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "rhmap/io/scan_sequence.hpp"

namespace rhmap::io {

inline bool isFinite(float x, float y, float z) { return std::isfinite(x) && std::isfinite(y) && std::isfinite(z); }

/// Adds a point of one of OctoMap's formats: OctoMap would skip a non-finite one when it updates the map.
inline void addPoint(Scan& scan, float x, float y, float z) {
  if (isFinite(x, y, z)) {
    scan.points.push_back(x, y, z);
  } else {
    ++scan.dropped;
  }
}

}  // namespace rhmap::io
