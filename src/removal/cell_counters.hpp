// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rhmap {

/// A word of 64 cells moved down by so many places, or up by fewer than none.
inline std::uint64_t shifted(std::uint64_t word, int by) {
  return by >= 64 || by <= -64 ? 0 : by >= 0 ? word >> by : word << -by;
}

/// 64 counters of N bits, bit-sliced: plane i holds bit i of each, so that one operation serves all.
template <std::size_t N>
class Counters {
 public:
  static constexpr unsigned kMost = (1U << N) - 1;

  /// One more for these cells, up to kMost.
  void countUp(std::uint64_t cells) {
    std::uint64_t full = ~std::uint64_t{0};
    for (const std::uint64_t plane : planes_) full &= plane;
    std::uint64_t carry = cells & ~full;
    for (std::uint64_t& plane : planes_) {
      const std::uint64_t next = plane & carry;
      plane ^= carry;
      carry = next;
    }
  }

  /// None for these cells.
  void reset(std::uint64_t cells) {
    for (std::uint64_t& plane : planes_) plane &= ~cells;
  }

  /// The cells that have counted to at least `n`; none where that is more than kMost.
  std::uint64_t atLeast(unsigned n) const {
    if (n > kMost) return 0;
    std::uint64_t larger = 0, equal = ~std::uint64_t{0};
    for (std::size_t i = N; i-- > 0;) {
      if (n >> i & 1) {
        equal &= planes_[i];
      } else {
        larger |= equal & planes_[i];
        equal &= ~planes_[i];
      }
    }
    return larger | equal;
  }

  /// The cells that have counted to more here than in others.
  std::uint64_t moreThan(const Counters& others) const {
    std::uint64_t more = 0, equal = ~std::uint64_t{0};
    for (std::size_t i = N; i-- > 0;) {
      more |= equal & planes_[i] & ~others.planes_[i];
      equal &= ~(planes_[i] ^ others.planes_[i]);
    }
    return more;
  }

  /// Moves all cells down by so many places.
  void shift(int by) {
    for (std::uint64_t& plane : planes_) plane = shifted(plane, by);
  }

 private:
  std::array<std::uint64_t, N> planes_{};
};

}  // namespace rhmap
