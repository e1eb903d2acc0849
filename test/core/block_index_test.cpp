// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/block_index.hpp"

#include <gtest/gtest.h>

#include <random>
#include <unordered_map>

namespace rhmap {
namespace {

TEST(BlockIndex, AgreesWithUnorderedMapOverRandomInsertionsAndDeletions) {
  BlockIndex<int> index;
  std::unordered_map<std::uint64_t, int*> oracle;
  std::vector<int> values(2000);
  std::mt19937_64 random(7);
  for (int step = 0; step < 200000; ++step) {
    // Few distinct keys, so that runs collide and deletions hit the middle of them.
    const std::uint64_t key = random() % 2000 * 0x100000001U;
    if (const auto it = oracle.find(key); it != oracle.end()) {
      ASSERT_EQ(index.find(key), it->second);
      ASSERT_EQ(index.findOrInsert(key, [] { return static_cast<int*>(nullptr); }), it->second);
      if (random() % 2 == 0) {
        index.erase(key);
        oracle.erase(it);
      }
    } else {
      ASSERT_EQ(index.find(key), nullptr);
      int* value = &values[random() % values.size()];
      if (random() % 2 == 0) {
        index.insert(key, value);
      } else {
        ASSERT_EQ(index.findOrInsert(key, [&] { return value; }), value);
      }
      oracle[key] = value;
    }
    ASSERT_EQ(index.size(), oracle.size());
  }
  for (const auto& [key, value] : oracle) ASSERT_EQ(index.find(key), value);
}

TEST(BlockIndex, VisitsEveryValueOnce) {
  BlockIndex<int> index;
  std::vector<int> values(1000, 0);
  for (std::uint64_t i = 0; i < values.size(); ++i) index.insert(i << 20, &values[i]);
  index.forEach([](int& v) { ++v; });
  for (const int v : values) EXPECT_EQ(v, 1);
}

TEST(BlockIndex, IsEmptyAfterClear) {
  BlockIndex<int> index;
  int value = 0;
  index.insert(5, &value);
  index.clear();
  EXPECT_EQ(index.find(5), nullptr);
  EXPECT_EQ(index.size(), 0U);
  index.insert(5, &value);
  EXPECT_EQ(index.find(5), &value);
}

}  // namespace
}  // namespace rhmap
