// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include "rhmap/core/key.hpp"

namespace rhmap::test {

/// Random cells that lie close together, so that leaves get pruned and pruned leaves get expanded: around the origin of
/// the key space, at its corners, or near some point, as the seed says.
class RandomCells {
 public:
  explicit RandomCells(unsigned seed) : random_(seed) {
    if (seed % 4 == 1) base_ = OcTreeKey(0, 65535 - 63, 0);
    if (seed % 4 == 2) base_ = OcTreeKey(40000, 1000, 32760);
  }

  int below(int n) { return std::uniform_int_distribution(0, n - 1)(random_); }
  double real(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

  OcTreeKey key() {
    const int extent = below(8) == 0 ? 64 : below(3) == 0 ? 20 : 6;
    OcTreeKey k;
    for (unsigned i = 0; i < 3; ++i) k[i] = static_cast<key_type>(base_[i] + below(extent));
    return k;
  }
  /// The smallest of the cells.
  OcTreeKey base() const { return base_; }

 private:
  std::mt19937 random_;
  OcTreeKey base_{32760, 32765, 32750};
};

}  // namespace rhmap::test
