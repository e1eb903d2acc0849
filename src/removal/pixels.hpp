// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace rhmap {

struct Projection;

/// The pixels of n places in the sensor's frame, row by row, -1 for those above and below the image; and how far away
/// the places are [m], if wanted (not null). As Projection::stepOf and columnOf say, to the bit, on every instruction
/// set.
void pixelsOf(const Projection& projection, const float* x, const float* y, const float* z, std::size_t n,
              std::int32_t* pixels, float* ranges = nullptr);

}  // namespace rhmap
