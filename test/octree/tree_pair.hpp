// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <octomap/Pointcloud.h>

#include <random>

#include "rhmap/core/key.hpp"

namespace rhmap::test {

/// A tree of ours and OctoMap's of the same type, and random cells in a small corner of them.
template <class OURS, class THEIRS>
class TreePair : public testing::TestWithParam<unsigned> {
 protected:
  TreePair() : random_(GetParam()) {}

  int below(int n) { return std::uniform_int_distribution(0, n - 1)(random_); }
  OcTreeKey key() {
    const int extent = below(3) == 0 ? 24 : 4;
    const auto axis = [&] { return static_cast<key_type>(32764 + below(extent)); };
    return {axis(), axis(), axis()};
  }
  point3d point() { return ours_.keyToCoord(key()); }
  octomap::Pointcloud scan() {
    octomap::Pointcloud points;
    for (int i = below(60); i >= 0; --i) points.push_back(point());
    return points;
  }

  /// The same call on both.
  template <class F>
  void both(F&& call) {
    call(ours_);
    call(theirs_);
  }

  std::mt19937 random_;
  OURS ours_{0.1};
  THEIRS theirs_{0.1};
};

}  // namespace rhmap::test
