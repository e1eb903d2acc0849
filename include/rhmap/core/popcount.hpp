// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace rhmap {

/// std::popcount in a dozen instructions. For that, GCC calls a function of its library unless it may count on an
/// instruction that the first x86-64 processors do not have.
constexpr int popcount(std::uint64_t bits) {
  bits -= bits >> 1 & 0x5555'5555'5555'5555;
  bits = (bits & 0x3333'3333'3333'3333) + (bits >> 2 & 0x3333'3333'3333'3333);
  bits = (bits + (bits >> 4)) & 0x0f0f'0f0f'0f0f'0f0f;
  return static_cast<int>(bits * 0x0101'0101'0101'0101 >> 56);
}

}  // namespace rhmap
