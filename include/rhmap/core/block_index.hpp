// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace rhmap {

/// Open-addressing hash table from 64-bit keys to pointers: linear probing, deletion by shifting back, so that a probe
/// sequence is one run of memory and there are no tombstones. `find` writes nothing: any number of threads may read.
/// No key may be 2^64 - 1.
template <class T>
class BlockIndex {
 public:
  /// The value under `key`, or null.
  [[gnu::always_inline]] T* find(std::uint64_t key) const {
    if (entries_.empty()) return nullptr;
    for (std::size_t i = home(key);; i = next(i)) {
      const Entry& e = entries_[i];
      if (e.key == key) return e.value;
      if (e.key == kNoKey) return nullptr;
    }
  }

  /// Asks for the memory that `find` will read first. Inlined by force, as all that does nothing else: to GCC 12 such a
  /// function has no effect, and its calls are dropped.
  [[gnu::always_inline]] void prefetch(std::uint64_t key) const {
    if (!entries_.empty()) __builtin_prefetch(&entries_[home(key)]);
  }

  /// Adds a key that is not there yet.
  void insert(std::uint64_t key, T* value) {
    if ((size_ + 1) * 2 > entries_.size()) grow();  // half empty: looking in vain ends soon, too
    place({key, value});
    ++size_;
  }

  /// The value under `key`; where there is none, make(), under this key from now on.
  template <class Make>
  T* findOrInsert(std::uint64_t key, Make&& make) {
    if ((size_ + 1) * 2 > entries_.size()) grow();
    for (std::size_t i = home(key);; i = next(i)) {
      if (entries_[i].key == key) return entries_[i].value;
      if (entries_[i].key != kNoKey) continue;
      entries_[i] = {key, make()};
      ++size_;
      return entries_[i].value;
    }
  }

  /// Takes out a key that is there.
  void erase(std::uint64_t key) {
    std::size_t hole = home(key);
    while (entries_[hole].key != key) hole = next(hole);
    for (std::size_t i = next(hole); entries_[i].value != nullptr; i = next(i)) {
      // An entry may move into the hole unless its home lies cyclically in (hole, i].
      const std::size_t h = home(entries_[i].key);
      if (((i - h) & mask_) >= ((i - hole) & mask_)) {
        entries_[hole] = entries_[i];
        hole = i;
      }
    }
    entries_[hole] = Entry{};
    --size_;
  }

  /// Forgets everything and gives the memory back.
  void clear() {
    entries_ = decltype(entries_)();
    shift_ = 64;
    mask_ = 0;
    size_ = 0;
  }

  /// Forgets everything and keeps the memory.
  void reset() {
    std::fill(entries_.begin(), entries_.end(), Entry{});
    size_ = 0;
  }

  std::size_t size() const { return size_; }
  std::size_t memoryUsage() const { return entries_.capacity() * sizeof(Entry); }

  template <class F>
  void forEach(F&& visit) const {
    for (const Entry& e : entries_)
      if (e.value != nullptr) visit(*e.value);
  }

  /// True if `holds` does for all.
  template <class F>
  bool all(F&& holds) const {
    for (const Entry& e : entries_)
      if (e.value != nullptr && !holds(*e.value)) return false;
    return true;
  }

 private:
  static constexpr std::uint64_t kNoKey = ~std::uint64_t{0};

  struct Entry {
    std::uint64_t key = kNoKey;
    T* value = nullptr;
  };

  std::size_t next(std::size_t i) const { return (i + 1) & mask_; }
  std::size_t home(std::uint64_t key) const { return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15U) >> shift_); }

  void place(const Entry& e) {
    std::size_t i = home(e.key);
    while (entries_[i].value != nullptr) i = next(i);
    entries_[i] = e;
  }

  void grow() {
    const std::vector<Entry> old =
        std::exchange(entries_, std::vector<Entry>(entries_.empty() ? 16 : entries_.size() * 2));
    shift_ = 64;
    for (std::size_t n = entries_.size(); n > 1; n /= 2) --shift_;
    mask_ = entries_.size() - 1;
    for (const Entry& e : old)
      if (e.value != nullptr) place(e);
  }

  std::vector<Entry> entries_;  // a power of two
  std::size_t size_ = 0;
  std::size_t mask_ = 0;  // entries_.size() - 1
  int shift_ = 64;
};

}  // namespace rhmap
