// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "rhmap/core/large_piece.hpp"

namespace rhmap {

/// Open-addressing hash table from 64-bit keys to pointers: linear probing, deletion by shifting back, so that a probe
/// sequence is one run of memory and there are no tombstones. Sequences begin at even places only, and two places are
/// looked at together: which of them holds a key is anybody's guess, and a guess would have to wait for memory before
/// it turns out wrong. `find` writes nothing: any number of threads may read. No key may be 2^64 - 1.
template <class T>
class BlockIndex {
 public:
  /// The value under `key`, or null.
  [[gnu::always_inline]] T* find(std::uint64_t key) const {
    if (pairs_.empty()) return nullptr;
    for (std::size_t i = home(key);; i = next(i)) {
      const Pair& pair = pairs_[i];
      const std::size_t place = pair.key[0] == key ? 0 : 1;
      if (pair.key[place] == key) return pair.value[place];
      if (pair.key[1] == kNoKey) return nullptr;  // the first is taken before the second
    }
  }

  /// Asks for the memory that `find` will read first. Inlined by force, as all that does nothing else: to GCC 12 such a
  /// function has no effect, and its calls are dropped.
  [[gnu::always_inline]] void prefetch(std::uint64_t key) const {
    if (!pairs_.empty()) __builtin_prefetch(&pairs_[home(key)]);
  }

  /// Adds a key that is not there yet.
  void insert(std::uint64_t key, T* value) {
    if (size_ + 1 > pairs_.size()) grow();  // half empty: looking in vain ends soon, too
    place(key, value);
    ++size_;
  }

  /// The value under `key`; where there is none, make(), under this key from now on.
  template <class Make>
  T* findOrInsert(std::uint64_t key, Make&& make) {
    if (T* value = find(key)) return value;
    T* value = make();
    insert(key, value);
    return value;
  }

  /// Takes out a key that is there.
  void erase(std::uint64_t key) {
    std::size_t hole = 2 * home(key);
    while (this->key(hole) != key) hole = (hole + 1) & lastPlace();
    for (std::size_t i = (hole + 1) & lastPlace(); value(i) != nullptr; i = (i + 1) & lastPlace()) {
      // An entry may move into the hole unless its home lies cyclically in (hole, i].
      const std::size_t h = 2 * home(this->key(i));
      if (((i - h) & lastPlace()) >= ((i - hole) & lastPlace())) {
        this->key(hole) = this->key(i);
        value(hole) = value(i);
        hole = i;
      }
    }
    this->key(hole) = kNoKey;
    value(hole) = nullptr;
    --size_;
  }

  /// Forgets everything and gives the memory back.
  void clear() {
    pairs_ = decltype(pairs_)();
    shift_ = 64;
    size_ = 0;
  }

  /// Forgets everything and keeps the memory.
  void reset() {
    std::fill(pairs_.begin(), pairs_.end(), Pair{});
    size_ = 0;
  }

  std::size_t size() const { return size_; }
  std::size_t memoryUsage() const { return pairs_.capacity() * sizeof(Pair); }

  template <class F>
  void forEach(F&& visit) const {
    for (const Pair& pair : pairs_)
      for (T* value : pair.value)
        if (value != nullptr) visit(*value);
  }

  /// True if `holds` does for all.
  template <class F>
  bool all(F&& holds) const {
    for (const Pair& pair : pairs_)
      for (const T* value : pair.value)
        if (value != nullptr && !holds(*value)) return false;
    return true;
  }

 private:
  static constexpr std::uint64_t kNoKey = ~std::uint64_t{0};

  /// Two places of the table, never on two lines of the cache.
  struct alignas(32) Pair {
    std::uint64_t key[2] = {kNoKey, kNoKey};
    T* value[2] = {};
  };

  std::size_t next(std::size_t pair) const { return (pair + 1) & (pairs_.size() - 1); }
  std::size_t home(std::uint64_t key) const { return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15U) >> shift_); }

  // Places one by one.
  std::size_t lastPlace() const { return 2 * pairs_.size() - 1; }
  std::uint64_t& key(std::size_t place) { return pairs_[place / 2].key[place % 2]; }
  T*& value(std::size_t place) { return pairs_[place / 2].value[place % 2]; }

  void place(std::uint64_t key, T* value) {
    std::size_t i = home(key);
    while (pairs_[i].value[1] != nullptr) i = next(i);
    const std::size_t free = pairs_[i].value[0] == nullptr ? 0 : 1;
    pairs_[i].key[free] = key;
    pairs_[i].value[free] = value;
  }

  void grow() {
    const auto old = std::exchange(pairs_, decltype(pairs_)(pairs_.empty() ? 8 : pairs_.size() * 2));
    shift_ = 65 - static_cast<int>(std::bit_width(pairs_.size()));
    for (const Pair& pair : old)
      for (int i = 0; i < 2; ++i)
        if (pair.value[i] != nullptr) place(pair.key[i], pair.value[i]);
  }

  std::vector<Pair, LargePageAllocator<Pair>> pairs_;  // a power of two
  std::size_t size_ = 0;
  int shift_ = 64;
};

}  // namespace rhmap
