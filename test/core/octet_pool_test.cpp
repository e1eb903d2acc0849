// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/octet_pool.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <set>
#include <vector>

namespace rhmap {
namespace {

struct LargeNode {
  double values[37];
};

template <class NODE>
class OctetPoolOf : public testing::Test {};
using Nodes = testing::Types<float, double, LargeNode>;
TYPED_TEST_SUITE(OctetPoolOf, Nodes);

/// Blocks with a pool, as a store has them.
template <class NODE>
struct Pool {
  PiecePool pieces;
  OctetPool<NODE> octets{pieces};
  std::deque<Block> blocks;

  Block& addBlock(int level = kRegionLevel) {
    Block& block = blocks.emplace_back();
    block.key = blockKey({0, 0, 0}, level);
    octets.enter(block);
    return block;
  }
  NODE* allocate(Block& block, int octet) {
    NODE* nodes = octets.allocate(octets.source(), block, octet);
    EXPECT_EQ(octets.nodes(block, octet), nodes);
    return nodes;
  }
  void release(Block& block, int octet) { octets.release(octets.source(), block, octet); }
};

TYPED_TEST(OctetPoolOf, FindsTheOwnerOfEveryInnerNodeFromItsAddress) {
  Pool<TypeParam> pool;
  for (int i = 0; i < 2000; ++i) {  // more than one slab
    Block& block = pool.addBlock(i % 2 == 0 ? kRegionLevel : 3);
    for (int number = i % 2 == 0 ? kMiddleOctet : 0; number < kOctets; ++number) {
      TypeParam* nodes = pool.allocate(block, number);
      for (int k = 0; k < 8; ++k)
        ASSERT_EQ(OctetPool<TypeParam>::locate(nodes + k), (NodeRef{&block, number * 8 + k})) << "block " << i;
    }
  }
}

TYPED_TEST(OctetPoolOf, KnowsThatLeavesHaveNoOwner) {
  Pool<TypeParam> pool;
  for (int i = 0; i < 1000; ++i) {
    Block& block = pool.addBlock();
    for (int number = 0; number < kMiddleOctet; ++number)
      ASSERT_FALSE(OctetPool<TypeParam>::locate(pool.allocate(block, number) + 7));
  }
}

TYPED_TEST(OctetPoolOf, HandsOutDistinctMemoryAndReusesWhatWasReleased) {
  Pool<TypeParam> pool;
  std::set<const TypeParam*> seen;
  for (int i = 0; i < 200; ++i) {
    Block& block = pool.addBlock();
    for (int number = 0; number < kOctets; ++number) ASSERT_TRUE(seen.insert(pool.allocate(block, number)).second);
  }
  const std::size_t used = pool.octets.memoryUsage();
  for (Block& block : pool.blocks)
    for (int number = 0; number < kOctets; ++number) pool.release(block, number);
  for (Block& block : pool.blocks)
    for (int number = 0; number < kOctets; ++number) ASSERT_FALSE(seen.insert(pool.allocate(block, number)).second);
  EXPECT_EQ(pool.octets.memoryUsage(), used);
}

/// A node of which a slab holds few, so that districts are full soon.
struct HugeNode {
  char bytes[2000];
};

TEST(OctetPool, NumbersOctetsByDistricts) {
  Pool<HugeNode> pool;
  std::vector<std::uint32_t> districts;  // as they are opened
  while (districts.size() < 3)
    if (const std::uint32_t district = pool.addBlock().first_slab; districts.empty() || districts.back() != district)
      districts.push_back(district);
  const std::size_t full = pool.blocks.size() / 2;  // blocks in each of the first two
  std::set<const HugeNode*> seen;
  for (std::size_t i = 0; i < pool.blocks.size(); i += full / 20) {
    Block& block = pool.blocks[i];
    EXPECT_EQ(block.first_slab, districts[i / full]);
    for (const int number : {0, 63, kMiddleOctet, kTopOctet}) {
      HugeNode* nodes = pool.allocate(block, number);
      ASSERT_TRUE(seen.insert(nodes).second);
      ASSERT_EQ(OctetPool<HugeNode>::locate(nodes + 3),
                number < kMiddleOctet ? NodeRef() : (NodeRef{&block, number * 8 + 3}));
    }
  }
  // A district that half of the blocks have left takes new ones, once the last is full.
  for (std::size_t i = 0; i <= full / 2; ++i) pool.octets.leave(pool.blocks[full + i]);
  std::set<std::uint32_t> entered;
  for (std::size_t i = 0; i < full + full / 4; ++i) entered.insert(pool.addBlock().first_slab);
  EXPECT_EQ(entered, (std::set<std::uint32_t>{districts[1], districts[2]}));
}

}  // namespace
}  // namespace rhmap
