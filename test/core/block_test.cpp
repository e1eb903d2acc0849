// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/block.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <set>

#include "rhmap/core/cell_word.hpp"
#include "rhmap/core/popcount.hpp"
#include "rhmap/core/region_lookahead.hpp"

namespace rhmap {
namespace {

/// OctoMap's own child numbers down to a depth, as one number.
unsigned pathTo(const OcTreeKey& key, unsigned from_depth, unsigned to_depth) {
  unsigned path = 0;
  for (unsigned d = from_depth; d < to_depth; ++d)
    path = path << 3 | octomap::computeChildIdx(key, static_cast<int>(kTreeDepth - 1 - d));
  return path;
}

TEST(Block, CellsAreInTheOrderOfOctomapsChildNumbers) {
  std::mt19937 random(1);
  for (int i = 0; i < 10000; ++i) {
    const OcTreeKey key(static_cast<key_type>(random()), static_cast<key_type>(random()),
                        static_cast<key_type>(random()));
    for (int level = 1; level <= kRegionLevel; ++level) {
      const auto depth = static_cast<unsigned>(3 * level + 1);
      ASSERT_EQ(static_cast<unsigned>(cellIndex(key, level)), pathTo(key, depth - 3, depth)) << "level " << level;
    }
    ASSERT_EQ(static_cast<unsigned>(cellIndex(key, 0)), pathTo(key, 0, 1));
  }
}

TEST(Popcount, IsTheStandardLibrarys) {
  std::mt19937_64 random(2);
  for (const std::uint64_t bits : {std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 63})
    EXPECT_EQ(popcount(bits), std::popcount(bits));
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t bits = i % 2 == 0 ? random() : random() & random() & random();
    ASSERT_EQ(popcount(bits), std::popcount(bits)) << bits;
  }
}

TEST(Block, NodesAreAddedToTheMasksOfEightOctets) {
  Block block{};
  block.mask[8] = 0b1001;
  addToMasks(block, 8, 0x80'00'00'00'00'00'10'06);
  EXPECT_EQ(block.mask[8], 0b1111);
  EXPECT_EQ(block.mask[9], 0x10);
  EXPECT_EQ(block.mask[15], 0x80);
  EXPECT_EQ(block.mask[7] | block.mask[10] | block.mask[16], 0);
}

TEST(Block, ParentAndChildOctetsAreInverse) {
  std::set<int> parents;
  for (int octet = 0; octet < kTopOctet; ++octet) {
    EXPECT_EQ(childOctet(parentSlot(octet)), octet);
    parents.insert(parentSlot(octet));
  }
  EXPECT_EQ(parents.size(), 72U);
  EXPECT_EQ(*parents.begin(), kMiddleSlot);
  EXPECT_EQ(*parents.rbegin(), kSlots - 1);
}

TEST(Block, ASlotsCornerIsTheSmallestKeyThatLeadsToIt) {
  std::mt19937 random(2);
  for (int level = 0; level <= kRegionLevel; ++level) {
    for (int i = 0; i < 2000; ++i) {
      const OcTreeKey key(static_cast<key_type>(random()), static_cast<key_type>(random()),
                          static_cast<key_type>(random()));
      Block block{};
      block.key = blockKey(key, level);
      for (int step = level == 0 ? 0 : -1; step <= 1; ++step) {
        const int slot = slotAbove(cellIndex(key, level), step);
        ASSERT_EQ(block.depth(slot), static_cast<unsigned>(3 * level + step));
        ASSERT_EQ(block.cornerOf(slot),
                  octomap::computeIndexKey(static_cast<key_type>(kTreeDepth - block.depth(slot)), key));
      }
    }
  }
}

TEST(Block, BlockKeysAreDistinctBetweenBlocksAndEqualWithin) {
  std::mt19937 random(3);
  for (int i = 0; i < 100000; ++i) {
    const OcTreeKey a(static_cast<key_type>(random()), static_cast<key_type>(random()),
                      static_cast<key_type>(random()));
    OcTreeKey b = a;
    const auto axis = static_cast<unsigned>(random() % 3);
    b[axis] ^= static_cast<key_type>(1U << random() % 16);
    for (int level = 0; level <= kRegionLevel; ++level) {
      const int shift = cellShift(level) + 3;
      bool same = true;
      for (unsigned axis = 0; axis < 3; ++axis) same = same && a[axis] >> shift == b[axis] >> shift;
      ASSERT_EQ(blockKey(a, level) == blockKey(b, level), same);
      if (level > 0) {
        ASSERT_NE(blockKey(a, level), blockKey(a, level - 1));
      }
    }
  }
}

TEST(Block, TheNextCellIsTheNextThatExists) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    Block block{};
    std::set<int> cells;
    for (int k = 0; k < i % 40; ++k) {
      const int cell = static_cast<int>(random() % kCells);
      cells.insert(cell);
      block.mask[static_cast<unsigned>(cell) >> 3] |= static_cast<std::uint8_t>(1U << (cell & 7));
    }
    for (int cell = 0; cell < kCells; ++cell) {
      const auto next = cells.upper_bound(cell);
      ASSERT_EQ(nextCell(block, cell), next == cells.end() ? kCells : *next) << "after " << cell;
    }
  }
}

TEST(CellWord, OutsideOfACubeIsWhatDiffersAboveItsBits) {
  std::mt19937 random(4);
  const auto key = [&] {
    return OcTreeKey(static_cast<key_type>(random()), static_cast<key_type>(random()), static_cast<key_type>(random()));
  };
  for (int i = 0; i < 5000; ++i) {
    const int bits = 3 + i % 14;
    const OcTreeKey a = key();
    OcTreeKey b = key();
    for (unsigned axis = 0; axis < 3; ++axis)  // as near as the cube is large, give or take
      b[axis] =
          static_cast<key_type>(a[axis] ^ (b[axis] & ((2U << bits) - 1) & ~(random() % 4 == 0 ? 1U << bits : 0U)));
    const bool inside = ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) >> bits == 0;
    ASSERT_EQ(((cell_word::fromKey(a) ^ cell_word::fromKey(b)) & cell_word::outsideOfCube(bits)) == 0, inside);
    ASSERT_EQ(cell_word::toKey(cell_word::fromKey(a)), a);
  }
}

}  // namespace
}  // namespace rhmap
