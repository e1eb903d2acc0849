// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace rhmap {

/// What is counted of 64 cubes, up to 255 each. One line of the cache.
using Tally = std::array<std::uint8_t, 64>;

/// One more for these cubes, in vectors. Returns which of them have come to `enough` (1 to 255).
std::uint64_t countUp(Tally& tally, std::uint64_t cubes, int enough);

/// One more, up to 255.
inline void countUp(std::uint8_t& counter) { counter = static_cast<std::uint8_t>(counter + (counter < 255)); }

}  // namespace rhmap
