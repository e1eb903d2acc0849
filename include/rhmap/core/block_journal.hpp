// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <unordered_set>
#include <vector>

namespace rhmap {

/// What has changed in a map since an observer last asked.
struct BlockChanges {
  bool all = false;                   ///< any block may have changed, come or gone
  std::vector<std::uint64_t> blocks;  ///< else: the blockKey() of each that did; ascending, so upper levels first
};

/// Whoever wants to know what changes in a map. It may outlive the map, and the map it.
class BlockObserver {
 public:
  /// False once the map is gone.
  bool connected() const { return pending_->connected.load(std::memory_order_acquire); }

 private:
  friend class BlockJournal;

  struct Pending {
    std::atomic<bool> connected{true};
    bool all = true;  // an observer knows nothing at first
    std::unordered_set<std::uint64_t> blocks;

    void add(const std::vector<std::uint64_t>& keys, std::size_t limit) {
      if (all) return;
      blocks.insert(keys.begin(), keys.end());
      if (blocks.size() > limit) addAll();
    }
    void addAll() {
      all = true;
      blocks = {};
    }
  };

  std::shared_ptr<Pending> pending_ = std::make_shared<Pending>();
};

/// Notes which blocks of a store have changed, for any number of observers.
///
/// A block carries the epoch in which it was last noted. An epoch ends when an observer takes its changes; within it a
/// block is noted once, and every further change costs a comparison. While nobody observes, the epoch is 0, and nothing
/// is ever noted.
///
/// observe() and take() count as reading the map: several threads may call them at once. The rest counts as changing.
class BlockJournal {
 public:
  /// `last_epoch`: the number to start after.
  explicit BlockJournal(std::uint32_t last_epoch = 0) : last_epoch_(last_epoch) {}
  BlockJournal(const BlockJournal&) = delete;
  BlockJournal& operator=(const BlockJournal&) = delete;
  ~BlockJournal() {
    forEachObserver([](BlockObserver::Pending& pending) { pending.connected.store(false, std::memory_order_release); });
  }

  /// Whether a block with this stamp needs no note(). A stamp is not read while nobody observes: the blocks of a scan
  /// lie all over the memory. What it says then is too old to count later.
  bool isNoted(const std::uint32_t& stamp) const { return epoch_ == 0 || stamp == epoch_; }

  /// Notes a block that is about to change. `blocks`: how many there are.
  void note(std::uint64_t key, std::uint32_t& stamp, std::size_t blocks) {
    log_.push_back(key);
    stamp = epoch_;
    if (log_.size() >= kLongLog) handOut(blocks);
  }

  /// Notes that any block may have changed.
  void noteAll() {
    log_.clear();
    forEachObserver([](BlockObserver::Pending& pending) { pending.addAll(); });
  }

  /// A new observer; what it takes first is `all`.
  BlockObserver observe() {
    const std::lock_guard lock(mutex_);
    BlockObserver observer;
    observers_.push_back(observer.pending_);
    if (epoch_ == 0) startEpoch();
    return observer;
  }

  /// What has changed since this observer last took it. `blocks`: how many there are.
  BlockChanges take(const BlockObserver& observer, std::size_t blocks) {
    const std::lock_guard lock(mutex_);
    handOut(blocks);
    BlockObserver::Pending& pending = *observer.pending_;
    BlockChanges changes{pending.all, {pending.blocks.begin(), pending.blocks.end()}};
    std::sort(changes.blocks.begin(), changes.blocks.end());
    if (!changes.all && changes.blocks.empty()) return changes;
    pending.blocks.clear();
    // Stamps of old epochs must never come again. After the last number (with a take every millisecond that is after
    // 50 days) changes are not told apart any more.
    pending.all = !startEpoch();
    return changes;
  }

  /// Exchanges the observers with another journal. To all of them everything has changed.
  void swapObservers(BlockJournal& other) {
    observers_.swap(other.observers_);
    for (BlockJournal* journal : {this, &other}) {
      journal->noteAll();
      if (journal->observers_.empty()) {
        journal->epoch_ = 0;
      } else if (journal->epoch_ == 0) {
        journal->startEpoch();
      }
    }
  }

 private:
  static constexpr std::size_t kLongLog = 4096;

  /// False if there are no more numbers.
  bool startEpoch() {
    if (last_epoch_ < std::numeric_limits<std::uint32_t>::max()) {
      epoch_ = ++last_epoch_;
      return true;
    }
    epoch_ = last_epoch_;
    return false;
  }

  /// Moves the log into the observers' sets. One who would have to look at as many blocks as there are, some of them
  /// gone, is told `all`: no more work for him, and a set that nobody empties stays bounded.
  void handOut(std::size_t blocks) {
    forEachObserver([&](BlockObserver::Pending& pending) { pending.add(log_, blocks); });
    log_.clear();
  }

  /// Visits those that live and forgets the others.
  template <class F>
  void forEachObserver(F&& visit) {
    std::erase_if(observers_, [&](const std::weak_ptr<BlockObserver::Pending>& observer) {
      const auto pending = observer.lock();
      if (pending != nullptr) visit(*pending);
      return pending == nullptr;
    });
    if (observers_.empty()) epoch_ = 0;
  }

  std::uint32_t epoch_ = 0;  // 0: nobody observes
  std::uint32_t last_epoch_;
  std::vector<std::uint64_t> log_;  // noted in this epoch and not yet in the observers' sets
  std::vector<std::weak_ptr<BlockObserver::Pending>> observers_;
  std::mutex mutex_;
};

}  // namespace rhmap
