// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/block_journal.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <optional>
#include <random>
#include <set>

#include "rhmap/core/block_store.hpp"

namespace rhmap {
namespace {

/// A journal as its store uses it: blocks are numbers, each with a stamp.
struct Store {
  explicit Store(std::uint32_t last_epoch = 0) : journal(last_epoch) {}

  void touch(std::uint64_t block) {
    std::uint32_t& stamp = stamps[block];
    if (journal.isNoted(stamp)) return;
    journal.note(block, stamp, stamps.size());
    ++notes;
  }
  BlockChanges take(const BlockObserver& observer) { return journal.take(observer, stamps.size()); }

  BlockJournal journal;
  std::map<std::uint64_t, std::uint32_t> stamps;
  int notes = 0;
};

struct Node : AbstractOcTreeNode {
  float value = 0;
};

std::vector<std::uint64_t> blocks(const BlockChanges& changes) {
  EXPECT_FALSE(changes.all);
  return changes.blocks;
}

using Blocks = std::vector<std::uint64_t>;

TEST(BlockJournal, NotesNothingWhileNobodyObserves) {
  Store store;
  for (int i = 0; i < 10; ++i) store.touch(7);
  EXPECT_EQ(store.notes, 0);
}

TEST(BlockJournal, SaysAllAtFirstAndThenEachBlockOnce) {
  Store store;
  for (std::uint64_t b = 0; b < 10; ++b) store.touch(b);
  const BlockObserver observer = store.journal.observe();
  EXPECT_TRUE(store.take(observer).all);
  EXPECT_EQ(blocks(store.take(observer)), Blocks{});
  for (int i = 0; i < 10; ++i)
    for (const std::uint64_t b : {5, 3, 5}) store.touch(b);
  EXPECT_EQ(store.notes, 2);
  EXPECT_EQ(blocks(store.take(observer)), (Blocks{3, 5}));
  EXPECT_EQ(blocks(store.take(observer)), Blocks{});
  store.touch(5);
  EXPECT_EQ(blocks(store.take(observer)), Blocks{5});
}

TEST(BlockJournal, TellsEveryObserverWhatIsNewToIt) {
  std::mt19937 random(5);
  Store store;
  for (std::uint64_t b = 0; b < 100; ++b) store.touch(b);
  struct Known {
    std::optional<BlockObserver> observer;
    bool all = true;
    std::set<std::uint64_t> changed;
  };
  std::vector<Known> observers(4);
  for (int i = 0; i < 20000; ++i) {
    const auto block = random() % 100;
    switch (random() % 12) {
      case 0: {  // comes, asks, or goes
        Known& known = observers[random() % observers.size()];
        if (!known.observer) {
          known = {store.journal.observe(), true, {}};
        } else if (random() % 8 == 0) {
          known.observer.reset();
        } else {
          const BlockChanges changes = store.take(*known.observer);
          ASSERT_EQ(changes.all, known.all) << i;
          if (!known.all) {
            ASSERT_EQ(changes.blocks, Blocks(known.changed.begin(), known.changed.end())) << i;
          }
          known.all = false;
          known.changed.clear();
        }
        break;
      }
      case 1:
        if (random() % 50 != 0) break;
        store.journal.noteAll();
        for (Known& known : observers) known.all = true;
        break;
      case 2:  // a block goes and comes: its stamp is that of a new one
        store.touch(block);
        for (Known& known : observers) known.changed.insert(block);
        store.stamps.erase(block);
        store.stamps[block] = 0;
        break;
      default:
        store.touch(block);
        for (Known& known : observers) known.changed.insert(block);
    }
  }
}

TEST(BlockJournal, SaysAllWhereMoreHasChangedThanThereIs) {
  Store store;
  const BlockObserver observer = store.journal.observe();
  store.take(observer);
  for (std::uint64_t b = 0; b < 100000; ++b) {
    store.touch(b);
    if (b >= 50) store.stamps.erase(b);  // a map that moves along, and nobody asks
  }
  EXPECT_TRUE(store.take(observer).all);
  EXPECT_FALSE(store.take(observer).all);
}

TEST(BlockJournal, NotesNothingAnyMoreWhenTheLastObserverIsGone) {
  Store store;
  { const BlockObserver observer = store.journal.observe(); }
  for (std::uint64_t b = 0; b < 10000; ++b) store.touch(b);  // it learns of it when it hands out
  store.notes = 0;
  for (std::uint64_t b = 10000; b < 11000; ++b) store.touch(b);
  EXPECT_EQ(store.notes, 0) << "nor are new blocks noted";
  const BlockObserver observer = store.journal.observe();
  store.take(observer);
  store.touch(9999);
  store.touch(1);  // with a stamp of the first observer's time
  EXPECT_EQ(blocks(store.take(observer)), (Blocks{1, 9999}));
}

TEST(BlockJournal, TellsObserversThatItIsGone) {
  std::optional<Store> store(std::in_place);
  const BlockObserver observer = store->journal.observe();
  EXPECT_TRUE(observer.connected());
  store.reset();
  EXPECT_FALSE(observer.connected());
}

TEST(BlockJournal, ExchangesObservers) {
  Store a, b;
  const BlockObserver of_a = a.journal.observe();
  a.take(of_a);
  for (std::uint64_t block = 0; block < 9; ++block) a.touch(block), b.touch(block);
  a.journal.swapObservers(b.journal);
  b.touch(1);
  EXPECT_TRUE(b.take(of_a).all);
  b.touch(2);
  a.touch(3);
  EXPECT_EQ(blocks(b.take(of_a)), Blocks{2});
  a.notes = 0;
  for (int i = 0; i < 5; ++i) a.touch(3);
  EXPECT_EQ(a.notes, 0) << "nobody observes a any more";
  a.journal.swapObservers(b.journal);
  EXPECT_TRUE(a.take(of_a).all);
  for (std::uint64_t block = 0; block < 9; ++block) a.touch(block);
  EXPECT_EQ(blocks(a.take(of_a)).size(), 9U);
}

TEST(BlockJournal, SaysAllWhenTheNumbersOfEpochsHaveRunOut) {
  Store store(std::numeric_limits<std::uint32_t>::max() - 3);
  for (std::uint64_t block = 0; block < 9; ++block) store.touch(block);
  const BlockObserver observer = store.journal.observe();
  for (int i = 0; i < 10; ++i) {
    const BlockChanges changes = store.take(observer);
    EXPECT_EQ(changes.all, i == 0 || i >= 3) << i;
    if (!changes.all) {
      EXPECT_EQ(changes.blocks, Blocks{5}) << i;
    }
    store.touch(5);
  }
}

TEST(BlockJournal, KnowsWhichBlocksOfAStoreGetAndLoseNodes) {
  BlockStore<Node> store;
  const BlockObserver observer = store.observe();
  EXPECT_TRUE(store.takeChanges(observer).all);
  const auto keysOf = [&](std::initializer_list<int> levels, const OcTreeKey& key) {
    Blocks keys;
    for (const int level : levels) keys.push_back(blockKey(key, level));
    return keys;
  };
  const OcTreeKey key(1000, 2000, 3000);
  NodeRef at = store.createRoot();
  EXPECT_EQ(blocks(store.takeChanges(observer)), keysOf({0}, key));
  while (at.depth() < kTreeDepth) {
    const unsigned bit = kTreeDepth - 1 - at.depth();
    at = store.createChild(at, (key[0] >> bit & 1) | (key[1] >> bit & 1) << 1 | (key[2] >> bit & 1) << 2);
  }
  EXPECT_EQ(blocks(store.takeChanges(observer)), keysOf({0, 1, 2, 3, 4, 5}, key));
  store.touch(at.block);
  store.touch(at.block);
  EXPECT_EQ(blocks(store.takeChanges(observer)), keysOf({5}, key));

  const NodeRef above = store.parent(store.parent(store.parent(at)));
  ASSERT_EQ(above.depth(), 13U);
  store.removeSubtree({at.block, slotAbove(cellIndex(key, 5), -1)});
  EXPECT_EQ(store.findRegion(key), nullptr);
  EXPECT_EQ(blocks(store.takeChanges(observer)), keysOf({5}, key)) << "a block that is gone is named, too";
  store.createChildren(above, 0xff);
  EXPECT_EQ(blocks(store.takeChanges(observer)), keysOf({5}, key)) << "and when it comes back";

  for (int level = 0; level <= kRegionLevel; ++level) {
    const Block* block = store.findBlock(key, level);
    EXPECT_EQ(block->key, blockKey(key, level));
    EXPECT_EQ(block->level(), level);
    EXPECT_EQ(block->corner(),
              level == 0 ? OcTreeKey(0, 0, 0) : octomap::computeIndexKey(static_cast<key_type>(18 - 3 * level), key));
  }
  store.clear();
  EXPECT_TRUE(store.takeChanges(observer).all);
  store.createRoot();
  EXPECT_EQ(blocks(store.takeChanges(observer)), keysOf({0}, key));
}

}  // namespace
}  // namespace rhmap
