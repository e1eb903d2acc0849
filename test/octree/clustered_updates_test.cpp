// SPDX-License-Identifier: BSD-3-Clause
// Updates of cells that lie close together use what the tree remembers of the last one (BlockStore::trunk). Whatever is
// done to the tree in between, OctoMap's values come out.
#include <gtest/gtest.h>

#include <random>

#include "oracle.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {
namespace {

using test::OctomapOracle;
using test::otBytes;

class ClusteredUpdates : public testing::TestWithParam<unsigned> {
 protected:
  int below(int n) { return std::uniform_int_distribution(0, n - 1)(random_); }

  /// Of one of 2 x 27 regions.
  OcTreeKey corner() {
    OcTreeKey k = below(4) == 0 ? OcTreeKey(0, 0, 0) : OcTreeKey(32760, 32760, 32760);
    for (unsigned i = 0; i < 3; ++i) k[i] = static_cast<key_type>(k[i] + 8 * below(3));
    return k;
  }
  OcTreeKey cellOf(OcTreeKey k) {
    for (unsigned i = 0; i < 3; ++i) k[i] = static_cast<key_type>(k[i] + below(8));
    return k;
  }
  /// A cell, mostly of the region of the one before.
  OcTreeKey key() {
    if (below(30) == 0) corner_ = corner();
    return cellOf(corner_);
  }

  template <class F>
  void both(F&& call) {
    call(ours_);
    call(theirs_);
    ASSERT_EQ(ours_.size(), theirs_.size());
  }

  /// Something that the tree is not told of, or that changes what lies above cells.
  void disturb() {
    const OcTreeKey k = key();
    const auto depth = static_cast<unsigned>(1 + below(16));
    const float value = static_cast<float>(below(7) - 3);
    switch (below(9)) {
      case 0:
      case 1:
      case 2:
        return both([&](auto& t) {
          if (auto* node = t.search(k, depth)) node->setLogOdds(value);
        });
      case 3:
        return both([&](auto& t) {
          if (t.getRoot() != nullptr) t.getRoot()->setLogOdds(value);
        });
      case 4:
        return both([&](auto& t) {
          if (t.size() > 1) t.deleteNode(k);
        });
      case 5:
        return both([&](auto& t) { t.prune(); });
      case 6:
        return both([&, other = cellOf(corner())](auto& t) { t.updateNode(other, value, true); });
      case 7:
        return both([&](auto& t) { t.insertRay(t.keyToCoord(k), t.keyToCoord(corner_)); });
      default:
        if (below(20) == 0) return both([](auto& t) { t.clear(); });
        // A region that is full of equal cells becomes one leaf. Another takes over its block.
        both([&](auto& t) {
          for (int cell = 0; cell < 512; ++cell)
            t.setNodeValue(OcTreeKey(static_cast<key_type>(corner_[0] + cell % 8),
                                     static_cast<key_type>(corner_[1] + cell / 8 % 8),
                                     static_cast<key_type>(corner_[2] + cell / 64)),
                           value);
        });
        corner_ = corner();
    }
  }

  std::mt19937 random_{GetParam()};
  OcTreeKey corner_ = corner();
  OcTree ours_{0.1};
  OctomapOracle theirs_{0.1};
};

TEST_P(ClusteredUpdates, GiveOctomapsValuesWhateverHappensInBetween) {
  for (int round = 0; round < 500; ++round) {
    for (int i = below(20); i >= 0; --i) {
      const OcTreeKey k = key();
      const bool hit = below(3) == 0;
      both([&](auto& t) { t.updateNode(k, hit); });
    }
    ASSERT_TRUE(otBytes(ours_) == otBytes(theirs_)) << "after updates, round " << round;
    if (below(2) == 0) disturb();
  }
}

TEST(ClusteredUpdate, SeeNodesThatALazyUpdateHasMadeBesideTheirWay) {
  OcTree ours(0.1);
  OctomapOracle theirs(0.1);
  const auto calls = [](auto& t) {
    t.updateNode(OcTreeKey(0, 0, 0), false);
    t.updateNode(OcTreeKey(1, 0, 0), false);
    t.updateNode(OcTreeKey(64, 0, 0), false, true);  // its inner nodes have the value 0 for now
    t.updateNode(OcTreeKey(2, 0, 0), false);
  };
  calls(ours);
  calls(theirs);
  EXPECT_TRUE(otBytes(ours) == otBytes(theirs));
}

INSTANTIATE_TEST_SUITE_P(Seeds, ClusteredUpdates, testing::Range(0U, 12U));

}  // namespace
}  // namespace rhmap
