// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/key_space.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "oracle.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {
namespace {

class KeySpaceAt : public testing::TestWithParam<double> {
 protected:
  OcTree ours_{GetParam()};
  test::OctomapOracle theirs_{GetParam()};
  std::mt19937 random_{11};

  double coordinate() {
    const double extent = 32768 * GetParam();
    switch (random_() % 4) {
      case 0:
        return std::uniform_real_distribution(-1.1 * extent, 1.1 * extent)(random_);
      case 1:
        return std::uniform_real_distribution(-10., 10.)(random_);
      case 2:
        return double(int(random_() % 2000) - 1000) * GetParam();  // on borders of cells
      default:
        return (double(int(random_() % 70000) - 35000) + 0.5) * GetParam();  // centres
    }
  }
};

TEST_P(KeySpaceAt, ConvertsAsOctomapDoes) {
  for (int i = 0; i < 200000; ++i) {
    const double x = coordinate();
    const auto depth = static_cast<unsigned>(1 + random_() % 16);
    ASSERT_EQ(ours_.coordToKey(x), theirs_.coordToKey(x)) << x;
    ASSERT_EQ(ours_.coordToKey(x, depth), theirs_.coordToKey(x, depth)) << x;
    key_type a = 1, b = 1;
    ASSERT_EQ(ours_.coordToKeyChecked(x, a), theirs_.coordToKeyChecked(x, b)) << x;
    ASSERT_EQ(a, b);
    ASSERT_EQ(ours_.coordToKeyChecked(x, depth, a), theirs_.coordToKeyChecked(x, depth, b)) << x;
    ASSERT_EQ(a, b);
  }
}

TEST_P(KeySpaceAt, ConvertsEveryKeyBackAsOctomapDoes) {
  for (unsigned k = 0; k <= 65535; ++k) {
    const auto key = static_cast<key_type>(k);
    ASSERT_EQ(ours_.keyToCoord(key), theirs_.keyToCoord(key));
    for (unsigned depth = 0; depth <= 16; ++depth) {
      ASSERT_EQ(ours_.keyToCoord(key, depth), theirs_.keyToCoord(key, depth)) << k << " at " << depth;
      ASSERT_EQ(ours_.adjustKeyAtDepth(key, depth), theirs_.adjustKeyAtDepth(key, depth)) << k << " at " << depth;
    }
  }
  for (unsigned depth = 0; depth <= 16; ++depth) ASSERT_EQ(ours_.getNodeSize(depth), theirs_.getNodeSize(depth));
}

TEST_P(KeySpaceAt, RefusesWhatIsNotFiniteOrFarAway) {
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity(), 1e300, -1e300, 3e9, -3e9}) {
    key_type key = 77;
    EXPECT_FALSE(ours_.coordToKeyChecked(x, key)) << x;
    EXPECT_EQ(key, 77);
    EXPECT_EQ(ours_.search(x, 0.0, 0.0), nullptr);
    EXPECT_EQ(ours_.updateNode(0.0, x, 0.0, true), nullptr);
    EXPECT_FALSE(ours_.deleteNode(0.0, 0.0, x));
    ours_.coordToKey(x);  // unchecked: any key, but no trap
  }
  EXPECT_EQ(ours_.size(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Resolutions, KeySpaceAt, testing::Values(0.001, 0.05, 0.1, 0.2, 0.37, 1.0, 3.3));

}  // namespace
}  // namespace rhmap
