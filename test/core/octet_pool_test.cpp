// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/octet_pool.hpp"

#include <gtest/gtest.h>

#include <set>

namespace rhmap {
namespace {

struct LargeNode {
  double values[37];
};

template <class NODE>
class OctetPoolOf : public testing::Test {};
using Nodes = testing::Types<float, double, LargeNode>;
TYPED_TEST_SUITE(OctetPoolOf, Nodes);

TYPED_TEST(OctetPoolOf, FindsTheOwnerOfEveryInnerNodeFromItsAddress) {
  OctetPool<TypeParam> pool;
  std::vector<Block> blocks(3);
  for (int i = 0; i < 60000; ++i) {  // more than one slab
    Block* block = &blocks[static_cast<std::size_t>(i % 3)];
    const int number = i % kOctets;
    TypeParam* nodes = pool.nodes(pool.allocateInner(block, number));
    for (int k = 0; k < 8; ++k)
      ASSERT_EQ(OctetPool<TypeParam>::locate(nodes + k), (NodeRef{block, number * 8 + k})) << "octet " << i;
  }
}

TYPED_TEST(OctetPoolOf, KnowsThatLeavesHaveNoOwner) {
  OctetPool<TypeParam> pool;
  for (int i = 0; i < 60000; ++i) {
    TypeParam* nodes = pool.nodes(pool.allocateLeaves());
    ASSERT_FALSE(OctetPool<TypeParam>::locate(nodes + 7));
  }
}

TYPED_TEST(OctetPoolOf, HandsOutDistinctMemoryAndReusesWhatWasReleased) {
  OctetPool<TypeParam> pool;
  Block block;
  std::set<const TypeParam*> seen;
  std::vector<OctetRef> refs;
  for (int i = 0; i < 10000; ++i) refs.push_back(i % 2 == 0 ? pool.allocateLeaves() : pool.allocateInner(&block, 0));
  for (const OctetRef ref : refs) ASSERT_TRUE(seen.insert(pool.nodes(ref)).second);
  const std::size_t used = pool.memoryUsage();
  for (const OctetRef ref : refs) pool.release(ref);
  for (int i = 0; i < 10000; ++i)
    ASSERT_FALSE(seen.insert(pool.nodes(i % 2 == 0 ? pool.allocateLeaves() : pool.allocateInner(&block, 0))).second);
  EXPECT_EQ(pool.memoryUsage(), used);
}

}  // namespace
}  // namespace rhmap
