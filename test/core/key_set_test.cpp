// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/key_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <type_traits>
#include <unordered_set>
#include <utility>
#include <vector>

#include "rhmap/core/block.hpp"

namespace rhmap {
namespace {

using Oracle = std::unordered_set<OcTreeKey, OcTreeKey::KeyHash>;

static_assert(std::forward_iterator<KeySet::const_iterator>);
static_assert(std::is_nothrow_move_constructible_v<KeySet>);
// `const OcTreeKey& key = *it++` must not refer into an iterator that is gone.
static_assert(std::is_same_v<decltype(*std::declval<KeySet::const_iterator>()), OcTreeKey>);

/// Keys from a few small boxes, some of them at the borders of the key space, so that runs meet the same cells again.
class RandomKeys {
 public:
  OcTreeKey operator()() {
    static constexpr key_type kCorners[] = {0, 0, 7, 32760, 40000, 65520};
    const auto axis = [&] { return static_cast<key_type>(kCorners[random_() % 6] + random_() % 16); };
    const key_type x = axis(), y = axis();
    return {x, y, axis()};
  }
  std::size_t below(std::size_t n) { return random_() % n; }

 private:
  std::mt19937_64 random_{11};
};

/// Everything that can be asked of a set agrees with the oracle.
void expectSame(const KeySet& set, const Oracle& oracle) {
  ASSERT_EQ(set.size(), oracle.size());
  ASSERT_EQ(set.empty(), oracle.empty());
  Oracle visited;
  for (const OcTreeKey& key : set) {
    ASSERT_TRUE(visited.insert(key).second) << "visited twice";
    ASSERT_TRUE(set.contains(key));
    ASSERT_EQ(*set.find(key), key);
  }
  ASSERT_EQ(visited, oracle);
}

TEST(KeySet, AgreesWithUnorderedSetOverRandomInsertionsAndErasures) {
  RandomKeys random;
  KeySet set;
  Oracle oracle;
  for (int step = 0; step < 200000; ++step) {
    const OcTreeKey key = random();
    const bool was_there = oracle.count(key) != 0;
    ASSERT_EQ(set.contains(key), was_there);
    ASSERT_EQ(set.count(key), oracle.count(key));
    ASSERT_EQ(set.find(key) != set.end(), was_there);
    // Phases of growth and of shrinking, down to nothing.
    if (step / 20000 % 2 == 0 ? random.below(3) != 0 : random.below(40) == 0) {
      const auto [it, is_new] = set.insert(key);
      ASSERT_EQ(*it, key);
      ASSERT_EQ(is_new, !was_there);
      oracle.insert(key);
    } else if (random.below(2) == 0 || set.empty()) {
      ASSERT_EQ(set.erase(key), oracle.erase(key));
    } else {
      const OcTreeKey first = *set.begin();
      oracle.erase(first);
      const auto after = set.erase(set.begin());
      ASSERT_EQ(after, set.begin());
      ASSERT_FALSE(set.contains(first));
    }
    ASSERT_EQ(set.size(), oracle.size());
    if (step % 1000 == 0) expectSame(set, oracle);
    if (step % 50000 == 49999) {
      set.clear();
      oracle.clear();
      expectSame(set, oracle);
    }
  }
}

TEST(KeySet, TakesRangesOfKeysAsUnorderedSetDoes) {
  RandomKeys random;
  KeySet set;
  Oracle oracle;
  for (int ray = 0; ray < 2000; ++ray) {
    OcTreeKey key = random();
    std::vector<OcTreeKey> keys;
    for (std::size_t n = random.below(60); n > 0; --n) {
      keys.push_back(key);
      key[static_cast<unsigned>(random.below(3))]++;  // may wrap from 65535 to 0
    }
    set.insert(keys.begin(), keys.end());
    oracle.insert(keys.begin(), keys.end());
    if (ray % 7 == 0) {
      const OcTreeKey gone = random();
      ASSERT_EQ(set.erase(gone), oracle.erase(gone));
    }
    if (ray % 100 == 0) expectSame(set, oracle);
  }
  expectSame(set, oracle);
  expectSame(KeySet(oracle.begin(), oracle.end()), oracle);
}

TEST(KeySet, HoldsTheEdgesOfTheKeySpace) {
  Oracle oracle;
  constexpr key_type kSome[] = {0, 7, 8, 32767, 32768, 65528, 65535};
  constexpr key_type kEdges[] = {0, 65535};
  for (const key_type x : kSome)
    for (const key_type y : kEdges)
      for (const key_type z : kEdges) {
        oracle.insert({x, y, z});
        oracle.insert({y, x, z});
        oracle.insert({y, z, x});
      }
  const KeySet set(oracle.begin(), oracle.end());
  expectSame(set, oracle);
  EXPECT_FALSE(set.contains({1, 0, 0}));
  EXPECT_FALSE(set.contains({0, 65534, 0}));
}

TEST(KeySet, AnEmptySetCanBeAsked) {
  const KeySet set;
  EXPECT_TRUE(set.empty());
  EXPECT_EQ(set.begin(), set.end());
  EXPECT_EQ(set.cbegin(), set.cend());
  EXPECT_EQ(set.find({0, 0, 0}), set.end());
  EXPECT_FALSE(set.contains({65535, 65535, 65535}));
  EXPECT_EQ(set, KeySet());
}

TEST(KeySet, GrowsToManyRegions) {
  KeySet set;
  std::mt19937 random(3);
  Oracle oracle;
  for (int i = 0; i < 100000; ++i) {
    const OcTreeKey key(static_cast<key_type>(random()), static_cast<key_type>(random()),
                        static_cast<key_type>(random()));
    ASSERT_EQ(set.insert(key).second, oracle.insert(key).second);
  }
  expectSame(set, oracle);
  for (const OcTreeKey& key : oracle) ASSERT_FALSE(set.insert(key).second);
}

TEST(KeySet, VisitsRegionsAsTheyCameAndTheirCellsInMortonOrder) {
  const OcTreeKey corners[] = {{4000, 8, 16}, {0, 65528, 0}, {8, 8, 8}};
  std::vector<OcTreeKey> expected;
  Block region{};
  for (const OcTreeKey& corner : corners) {
    region.key = blockKey(corner, kRegionLevel);
    for (int cell = 0; cell < kCells; cell += 3) expected.push_back(region.cornerOf(cell));
  }
  KeySet set;
  for (const OcTreeKey& corner : corners) set.insert(corner);
  set.insert(expected.rbegin(), expected.rend());
  EXPECT_EQ(std::vector(set.begin(), set.end()), expected);
}

TEST(KeySet, CellsCanBeErasedWhileVisiting) {
  RandomKeys random;
  KeySet set;
  Oracle kept, erased;
  for (int i = 0; i < 20000; ++i) set.insert(random());
  for (auto it = set.begin(); it != set.end();) {
    const OcTreeKey key = *it;
    if ((key[0] + key[1] + key[2]) % 3 != 0) {
      it = set.erase(it);
      ASSERT_TRUE(erased.insert(key).second);
    } else {
      ++it;
      ASSERT_TRUE(kept.insert(key).second);
    }
  }
  expectSame(set, kept);
  for (const OcTreeKey& key : erased) ASSERT_FALSE(set.contains(key));
}

TEST(KeySet, IteratorsOutliveErasuresAndInsertionsOfOtherCells) {
  KeySet set{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {800, 0, 0}};
  auto it = set.find({1, 0, 0});
  const auto end = set.end();
  EXPECT_EQ(set.erase(OcTreeKey(0, 0, 0)), 1U);
  EXPECT_EQ(set.erase(OcTreeKey(2, 0, 0)), 1U);
  for (key_type k = 0; k < 5000; ++k) set.insert({k, 60000, 0});
  EXPECT_EQ(*it, OcTreeKey(1, 0, 0));
  EXPECT_EQ(*++it, OcTreeKey(800, 0, 0));
  EXPECT_EQ(std::distance(it, end), 5001);
}

TEST(KeySet, ErasesRanges) {
  KeySet set{{0, 0, 0}, {1, 0, 0}, {800, 0, 0}, {801, 0, 0}, {0, 800, 0}};
  const auto rest = set.erase(set.find({1, 0, 0}), set.find({801, 0, 0}));
  EXPECT_EQ(*rest, OcTreeKey(801, 0, 0));
  EXPECT_EQ(set, (KeySet{{0, 0, 0}, {801, 0, 0}, {0, 800, 0}}));
  EXPECT_EQ(set.erase(set.begin(), set.end()), set.end());
  EXPECT_TRUE(set.empty());
  EXPECT_EQ(set.begin(), set.end());
}

TEST(KeySet, FindsAgainWhatIsInsertedBeforeErasedRegions) {
  KeySet set{{0, 0, 0}, {800, 0, 0}};
  set.insert({0, 0, 0});  // the region that is reached last
  set.erase(OcTreeKey(0, 0, 0));
  EXPECT_EQ(*set.begin(), OcTreeKey(800, 0, 0));
  set.insert({1, 0, 0});
  EXPECT_EQ(*set.begin(), OcTreeKey(1, 0, 0));
  EXPECT_EQ(std::distance(set.begin(), set.end()), 2);
}

TEST(KeySet, SwapTakesAlongThatTheFirstRegionsAreEmpty) {
  KeySet a{{0, 0, 0}, {800, 0, 0}};
  KeySet b{{5, 5, 5}, {900, 0, 0}};
  a.erase(OcTreeKey(0, 0, 0));
  a.swap(b);
  EXPECT_EQ(std::vector(a.begin(), a.end()), (std::vector<OcTreeKey>{{5, 5, 5}, {900, 0, 0}}));
  EXPECT_EQ(std::vector(b.begin(), b.end()), (std::vector<OcTreeKey>{{800, 0, 0}}));
}

TEST(KeySet, CopiesAreIndependentAndMovesLeaveAnEmptySet) {
  const KeySet original{{1, 2, 3}, {65535, 0, 9}};
  KeySet copy = original;
  copy.insert({4, 4, 4});
  copy.erase(OcTreeKey(1, 2, 3));
  EXPECT_EQ(original, (KeySet{{65535, 0, 9}, {1, 2, 3}}));
  EXPECT_EQ(copy, (KeySet{{4, 4, 4}, {65535, 0, 9}}));

  KeySet moved = std::move(copy);
  EXPECT_EQ(moved, (KeySet{{4, 4, 4}, {65535, 0, 9}}));
  EXPECT_EQ(copy, KeySet());  // NOLINT: ours says so
  EXPECT_EQ(copy.begin(), copy.end());
  copy.insert({1, 1, 1});
  EXPECT_EQ(copy, KeySet({{1, 1, 1}}));

  swap(copy, moved);
  EXPECT_EQ(moved, KeySet({{1, 1, 1}}));
  copy = original;
  EXPECT_EQ(copy, original);
  const KeySet& itself = copy;
  copy = itself;
  EXPECT_EQ(copy, original);
  copy = KeySet();
  EXPECT_TRUE(copy.empty());
}

TEST(KeySet, IsEqualWhateverTheOrderAndWhateverWasErased) {
  const KeySet a{{1, 2, 3}, {800, 2, 3}};
  KeySet b{{5000, 0, 0}, {800, 2, 3}, {1, 2, 3}};
  EXPECT_NE(a, b);
  b.erase(OcTreeKey(5000, 0, 0));
  EXPECT_EQ(a, b);
  EXPECT_EQ(b, a);
  b.erase(OcTreeKey(1, 2, 3));
  b.insert({1, 2, 4});
  EXPECT_NE(a, b);
  EXPECT_NE(a, (KeySet{{801, 2, 3}, {802, 2, 3}}));
  EXPECT_NE(a, (KeySet{{1, 2, 3}, {1600, 2, 3}}));
}

TEST(KeySet, ClearLeavesAnEmptySetThatCanBeFilledAgain) {
  RandomKeys random;
  KeySet set;
  for (int round = 0; round < 5; ++round) {
    Oracle oracle;
    for (int i = 0; i < 3000; ++i) {
      const OcTreeKey key = random();
      set.insert(key);
      oracle.insert(key);
    }
    expectSame(set, oracle);
    set.clear();
    expectSame(set, {});
    for (const OcTreeKey& key : oracle) ASSERT_FALSE(set.contains(key));
  }
}

TEST(KeySet, HasTheOtherDoorsOfUnorderedSet) {
  KeySet set;
  set.reserve(1000);
  set.rehash(1000);
  EXPECT_TRUE(set.emplace(key_type{1}, key_type{2}, key_type{3}).second);
  EXPECT_FALSE(set.emplace(OcTreeKey(1, 2, 3)).second);
  EXPECT_EQ(set.insert(set.begin(), OcTreeKey(7, 7, 7))->k[1], 7);
  EXPECT_EQ(*set.emplace_hint(set.end(), key_type{9}, key_type{9}, key_type{9}), OcTreeKey(9, 9, 9));
  set.insert({{1, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(set, (KeySet{{1, 2, 3}, {7, 7, 7}, {9, 9, 9}, {4, 5, 6}}));

  std::vector<OcTreeKey> inserted{{100, 0, 0}};
  std::copy(inserted.begin(), inserted.end(), std::inserter(set, set.end()));
  EXPECT_EQ(set.count({100, 0, 0}), 1U);

  auto it = set.begin();
  const OcTreeKey& first = *it++;  // a key of its own: the iterator has moved on
  EXPECT_EQ(first, *set.begin());
  EXPECT_NE(first, *it);
}

}  // namespace
}  // namespace rhmap
