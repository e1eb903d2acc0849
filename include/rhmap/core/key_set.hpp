// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "rhmap/core/key.hpp"

namespace rhmap {

/// A set of cells with the interface of std::unordered_set<OcTreeKey>, kept region-wise: 512 bits for each region, and
/// a hash table that finds the region. Made for rays: seven of eight cells along a ray lie in the region of the one
/// before, and inserting them is an OR.
///
/// Cells are visited region by region, in the order in which the regions came, and in Morton order within a region.
///
/// An iterator is a place in the set and holds the key that it found there. Neither inserting nor erasing, of any cell,
/// makes it invalid; clear, swap, assignment and moving the set do. Unlike in std a reference to a key is one into its
/// iterator: it changes when the iterator moves on. A region stays when its last cell is erased, until clear().
///
/// Const members write nothing: any number of threads may call them.
class KeySet {
 public:
  using key_type = OcTreeKey;
  using value_type = OcTreeKey;
  using size_type = std::size_t;
  using difference_type = std::ptrdiff_t;
  using hasher = OcTreeKey::KeyHash;
  using reference = const OcTreeKey&;
  using const_reference = const OcTreeKey&;

  class const_iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = OcTreeKey;
    using difference_type = std::ptrdiff_t;
    using pointer = const OcTreeKey*;
    using reference = const OcTreeKey&;

    const_iterator() = default;
    const OcTreeKey& operator*() const& { return key_; }
    OcTreeKey operator*() const&& { return key_; }  // so that `const OcTreeKey& first = *set.begin()` is safe
    const OcTreeKey* operator->() const { return &key_; }
    const_iterator& operator++() { return *this = const_iterator(set_, set_->next(place_ + 1)); }
    const_iterator operator++(int) {
      const const_iterator old = *this;
      ++*this;
      return old;
    }
    bool operator==(const const_iterator& other) const { return place_ == other.place_; }

   private:
    friend class KeySet;
    const_iterator(const KeySet* set, std::size_t place) : set_(set), place_(place) {
      if (place != kNowhere) key_ = set->keyAt(place);
    }

    const KeySet* set_ = nullptr;
    std::size_t place_ = kNowhere;
    OcTreeKey key_{0, 0, 0};
  };
  using iterator = const_iterator;

  KeySet() = default;
  /// The number of buckets to begin with means nothing here.
  explicit KeySet(size_type /*buckets*/) {}
  template <std::input_iterator It>
  KeySet(It first, It last) {
    insert(first, last);
  }
  KeySet(std::initializer_list<OcTreeKey> keys) { insert(keys); }
  KeySet(const KeySet&) = default;
  KeySet(KeySet&& other) noexcept { swap(other); }
  KeySet& operator=(KeySet other) noexcept {
    swap(other);
    return *this;
  }
  ~KeySet() = default;

  void swap(KeySet& other) noexcept {
    regions_.swap(other.regions_);
    table_.swap(other.table_);
    std::swap(last_, other.last_);
    std::swap(first_, other.first_);
    std::swap(size_, other.size_);
  }
  friend void swap(KeySet& a, KeySet& b) noexcept { a.swap(b); }

  // --- reading ---

  bool empty() const { return size_ == 0; }
  size_type size() const { return size_; }

  const_iterator begin() const { return {this, next(first_ * kRegionCells)}; }
  const_iterator end() const { return {this, kNowhere}; }
  const_iterator cbegin() const { return begin(); }
  const_iterator cend() const { return end(); }

  const_iterator find(const OcTreeKey& key) const { return {this, placeOf(key)}; }
  bool contains(const OcTreeKey& key) const { return placeOf(key) != kNowhere; }
  size_type count(const OcTreeKey& key) const { return contains(key) ? 1 : 0; }

  bool operator==(const KeySet& other) const;

  // --- changing ---

  std::pair<iterator, bool> insert(const OcTreeKey& key) {
    const unsigned cell = cellOf(key);
    const bool is_new = reachRegion(nameOf(key)).mark(cell);
    size_ += is_new;
    return {const_iterator(this, last_ * kRegionCells + cell), is_new};
  }
  iterator insert(const_iterator /*hint*/, const OcTreeKey& key) { return insert(key).first; }
  void insert(std::initializer_list<OcTreeKey> keys) { insert(keys.begin(), keys.end()); }
  template <std::input_iterator It>
  void insert(It first, It last) {
    std::uint64_t name = ~std::uint64_t{0};  // of the key before
    Region* region = nullptr;
    for (; first != last; ++first) {
      const OcTreeKey& key = *first;
      if (nameOf(key) != name) region = &reachRegion(name = nameOf(key));
      size_ += region->mark(cellOf(key));
    }
  }
  template <class... Args>
  std::pair<iterator, bool> emplace(Args&&... args) {
    return insert(OcTreeKey(std::forward<Args>(args)...));
  }
  template <class... Args>
  iterator emplace_hint(const_iterator hint, Args&&... args) {
    return insert(hint, OcTreeKey(std::forward<Args>(args)...));
  }

  size_type erase(const OcTreeKey& key) {
    const std::size_t place = placeOf(key);
    if (place == kNowhere) return 0;
    erase(const_iterator(this, place));
    return 1;
  }
  /// The cell after it.
  iterator erase(const_iterator at) {
    regions_[at.place_ / kRegionCells].erase(at.place_ % kRegionCells);
    --size_;
    while (first_ < regions_.size() && regions_[first_].octants == Octants{}) ++first_;
    return ++at;
  }
  iterator erase(const_iterator first, const_iterator last) {
    while (first != last) first = erase(first);
    return first;
  }

  /// Keeps the memory for what comes next.
  void clear() {
    regions_.clear();
    std::fill(table_.begin(), table_.end(), 0);
    last_ = first_ = size_ = 0;
  }

  /// Nothing to do: how many regions so many cells lie in is not known beforehand.
  void reserve(size_type /*cells*/) {}
  void rehash(size_type /*buckets*/) {}

 private:
  static constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();
  static constexpr std::size_t kRegionCells = 512;
  using Octants = std::array<std::uint64_t, 8>;

  struct Region {
    std::uint64_t name;
    Octants octants{};  ///< cells in Morton order, one word an octant

    bool has(unsigned cell) const { return octants[cell / 64] >> cell % 64 & 1; }
    /// True if the cell was not there yet.
    bool mark(unsigned cell) {
      const std::uint64_t before = octants[cell / 64];
      return (octants[cell / 64] = before | std::uint64_t{1} << cell % 64) != before;
    }
    void erase(std::size_t cell) { octants[cell / 64] &= ~(std::uint64_t{1} << cell % 64); }
  };

  /// A region's smallest key, 16 bits an axis.
  static std::uint64_t nameOf(const OcTreeKey& key) {
    return (std::uint64_t{key[0]} | std::uint64_t{key[1]} << 16 | std::uint64_t{key[2]} << 32) & 0xfff8fff8fff8;
  }
  /// cellIndex(key, kRegionLevel), quicker: this is done for every key of every ray.
  static unsigned cellOf(const OcTreeKey& key) {
    return kSpread[key[0] & 7] | kSpread[key[1] & 7] << 1 | kSpread[key[2] & 7] << 2;
  }
  static constexpr std::array<unsigned, 8> kSpread{spread3(0), spread3(1), spread3(2), spread3(3),
                                                   spread3(4), spread3(5), spread3(6), spread3(7)};

  // A place is the number of a region times kRegionCells, plus the cell.

  OcTreeKey keyAt(std::size_t place) const {
    const std::uint64_t name = regions_[place / kRegionCells].name;
    return keyOfWord(name | cellOffset(static_cast<unsigned>(place % kRegionCells)));
  }

  /// First place from this one on that has a cell.
  std::size_t next(std::size_t place) const {
    for (std::size_t octant = place / 64, used = ~std::uint64_t{0} << place % 64; octant < regions_.size() * 8;
         ++octant, used = ~std::uint64_t{0})
      if (const std::uint64_t cells = regions_[octant / 8].octants[octant % 8] & used; cells != 0)
        return octant * 64 + static_cast<unsigned>(std::countr_zero(cells));
    return kNowhere;
  }

  std::size_t placeOf(const OcTreeKey& key) const {
    const std::size_t region = findRegion(nameOf(key));
    const unsigned cell = cellOf(key);
    return region != kNowhere && regions_[region].has(cell) ? region * kRegionCells + cell : kNowhere;
  }

  /// Where the table names this region, or the free slot for it. The table is never full.
  std::size_t slotOf(std::uint64_t name) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t slot = (name * 0x9e3779b97f4a7c15U >> 32) & mask;
    while (table_[slot] != 0 && regions_[table_[slot] - 1].name != name) slot = (slot + 1) & mask;
    return slot;
  }

  std::size_t findRegion(std::uint64_t name) const {
    const std::uint32_t number = table_.empty() ? 0 : table_[slotOf(name)];
    return number != 0 ? number - 1 : kNowhere;
  }

  /// The region of this name for a cell to come, made if it is not there. `last_` tells its number.
  Region& reachRegion(std::uint64_t name) {
    if (last_ >= regions_.size() || regions_[last_].name != name) last_ = getOrCreateRegion(name);
    first_ = std::min(first_, last_);
    return regions_[last_];
  }
  std::size_t getOrCreateRegion(std::uint64_t name);
  void grow();

  std::vector<Region> regions_;       // in the order in which they came
  std::vector<std::uint32_t> table_;  // open addressing, a power of two; 0: free, else 1 + a region's number
  std::size_t last_ = 0;              // where a key was inserted last
  std::size_t first_ = 0;             // no region before it has cells
  std::size_t size_ = 0;
};

}  // namespace rhmap
