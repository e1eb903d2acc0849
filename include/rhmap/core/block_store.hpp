// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "rhmap/core/block.hpp"
#include "rhmap/core/block_index.hpp"
#include "rhmap/core/block_journal.hpp"
#include "rhmap/core/block_search.hpp"
#include "rhmap/core/octet_pool.hpp"
#include "rhmap/core/popcount.hpp"
#include "rhmap/core/record_pool.hpp"
#include "rhmap/core/region_editor.hpp"
#include "rhmap/core/trunk.hpp"

namespace rhmap {

/// Eight siblings: which of them exist, and where they are. `nodes` is null where none exists.
template <class NODE>
struct Octet {
  NODE* nodes = nullptr;
  std::uint8_t mask = 0;
  bool has(unsigned i) const { return mask >> i & 1; }
};

/// The structure of an octree in a two-layer hash map: blocks found by hashing, nodes found inside a block by index.
/// Knows nodes, not occupancy. The exact octree is kept: a node is a leaf when it exists and has no existing child.
///
/// Invariants: a node exists only if its parent does; a block exists only while one of its nodes does.
/// Reading is const and writes nothing. Addresses of nodes stay until the node is removed.
template <class NODE>
class BlockStore {
 public:
  BlockStore() = default;
  ~BlockStore() { clear(); }
  BlockStore(const BlockStore&) = delete;
  BlockStore& operator=(const BlockStore&) = delete;

  /// Number of existing nodes, inner ones and the root included.
  std::size_t size() const { return size_; }
  bool empty() const { return root_ == nullptr; }
  /// Goes up whenever nodes are made or removed.
  std::uint64_t version() const { return version_; }

  // --- finding ---

  /// The block of this level around `key`, or null.
  Block* findBlock(const OcTreeKey& key, int level) const { return findBlock(blockKey(key, level)); }
  Block* findBlock(std::uint64_t block_key) const { return index_.find(block_key); }
  /// The region around `key`, or null.
  Block* findRegion(const OcTreeKey& key) const { return findBlock(key, kRegionLevel); }

  /// Asks for the memory that findRegion() will read first.
  [[gnu::always_inline]] void prefetchRegion(const OcTreeKey& key) const {
    index_.prefetch(blockKey(key, kRegionLevel));
  }

  /// The root, or empty.
  NodeRef root() const { return root_ != nullptr ? NodeRef{root_, kRootSlot} : NodeRef{}; }

  /// The cell at `key`, or the shallower leaf that contains it; null if unknown.
  [[gnu::always_inline]] NODE* findNode(const OcTreeKey& key) const {
    if (const Block* region = findRegion(key))
      return findNode(*region, static_cast<unsigned>(cellIndex(key, kRegionLevel)));
    return findNodeAbove(key);
  }
  /// The same for a cell of this region.
  [[gnu::always_inline]] NODE* findNode(const Block& region, unsigned cell) const {
    const CellPlace place = likelyPlaceOf(region, cell);
    if (!place.exists()) return nullptr;
    NODE* node = nodes_.nodes(region, static_cast<int>(place.octet)) + place.child;
    if (node == nullptr) __builtin_unreachable();  // whoever tests what was found need not test it twice
    return node;
  }
  /// The same where there is no region.
  [[gnu::noinline]] NODE* findNodeAbove(const OcTreeKey& key) const {
    return nodeOrNull(searchAbove(key, kRegionLevel).node);
  }

  /// The node at `depth` around `key`, or the shallower leaf that contains it; empty if unknown.
  NodeRef search(const OcTreeKey& key, unsigned depth = kTreeDepth) const {
    const int level = static_cast<int>(depth + 1) / 3;
    Block* block = findBlock(key, level);
    if (block == nullptr) return searchAbove(key, level).node;
    return searchIn(block, slotAbove(cellIndex(key, level), static_cast<int>(depth) - 3 * level));
  }

  /// searchCell() where there is no block of this level.
  Found searchAbove(const OcTreeKey& key, int level) const {
    while (--level >= 0) {
      Block* block = findBlock(key, level);
      if (block == nullptr) continue;
      // A cell whose own block was not found has no children: it is what contains the key.
      Found found = searchCell(block, cellIndex(key, level));
      found.bits = std::min(found.bits + cellShift(level), static_cast<int>(kTreeDepth));  // above the root is nothing
      return found;
    }
    return {{}, static_cast<int>(kTreeDepth)};
  }

  /// The deepest existing node on the way to `key`; empty in an empty tree.
  NodeRef deepest(const OcTreeKey& key) const {
    for (int l = kRegionLevel; l >= 0; --l) {
      Block* block = findBlock(key, l);
      if (block == nullptr) continue;
      const int cell = cellIndex(key, l);
      for (int slot = cell; slot < kSlots; slot = parentSlot(slot >> 3))
        if (block->has(slot)) return {block, slot};
      return parent({block, kTopSlot});
    }
    return {};
  }

  // --- around a node ---

  NODE* node(NodeRef r) const { return nodes_.nodes(*r.block, r.slot >> 3) + (r.slot & 7); }

  NODE* nodeOrNull(NodeRef r) const { return r ? node(r) : nullptr; }

  /// Where a node of this store sits; empty for a depth-16 leaf (which has no children to ask for).
  static NodeRef locate(const NODE* node) { return OctetPool<NODE>::locate(node); }

  /// The parent; empty for the root.
  static NodeRef parent(NodeRef r) {
    if (r.slot >= kTopSlot) return {r.block->parent, cellIndex(r.block->corner(), r.block->level() - 1)};
    if (r.slot == kRootSlot && r.block->level() == 0) return {};
    return {r.block, parentSlot(r.slot >> 3)};
  }

  /// The octet below a node as (block, number); empty if it has no children. The number stands in `slot`.
  NodeRef childOctetOf(NodeRef r) const {
    if (r.slot >= kCells) return {r.block->mask[childOctet(r.slot)] != 0 ? r.block : nullptr, childOctet(r.slot)};
    if (r.block->level() == kRegionLevel) return {};
    return {findBlock(r.corner(), r.block->level() + 1), kTopOctet};
  }

  bool hasChildren(NodeRef r) const { return static_cast<bool>(childOctetOf(r)); }

  Octet<NODE> children(NodeRef r) const {
    const NodeRef o = childOctetOf(r);
    return o ? octet(o.block, o.slot) : Octet<NODE>{};
  }

  /// Octet `number` of a block; mask[number] must not be 0.
  Octet<NODE> octet(const Block* block, int number) const {
    return {nodes_.nodes(*block, number), block->mask[number]};
  }

  /// True if any of the eight nodes of this octet has children.
  bool anyHasChildren(NodeRef octet) const {
    const Block* block = octet.block;
    if (octet.slot >= kMiddleOctet) {
      for (int i = 0; i < 8; ++i)
        if (block->mask[childOctet(octet.slot * 8 + i)] != 0) return true;
      return false;
    }
    if (block->level() == kRegionLevel) return false;
    for (int i = 0; i < 8; ++i)
      if (findBlock(block->cornerOf(octet.slot * 8 + i), block->level() + 1) != nullptr) return true;
    return false;
  }

  // --- changing ---

  /// deepest(), quicker if the way to `key` is the one that trunk() remembers. Not const, though it writes nothing: it
  /// is for those who change cells.
  NodeRef deepestToChange(const OcTreeKey& key) {
    if (!trunk_.leadsTo(key)) return deepest(key);
    for (int slot = cellIndex(key, kRegionLevel); slot < kSlots; slot = parentSlot(slot >> 3))
      if (trunk_.region->has(slot)) return {trunk_.region, slot};
    return parent({trunk_.region, kTopSlot});
  }

  /// True if a cell of this region was the last to be changed, so that remembering the way up pays.
  bool isChangedAgain(Block* region) { return std::exchange(last_changed_, region) == region; }

  /// The way up from an existing region, remembered until it is asked for another.
  Trunk<NODE>& trunk(Block* region) {
    if (trunk_.region == region) return trunk_;
    NodeRef child{region, kTopSlot};
    for (typename Trunk<NODE>::Step& step : trunk_.steps) {
      const NodeRef at = parent(child);
      const Octet<NODE> siblings = octet(child.block, child.slot >> 3);
      step.block = at.block;
      step.node = node(at);
      step.children = siblings.nodes;
      step.mask = &child.block->mask[static_cast<std::size_t>(child.slot >> 3)];
      child = at;
    }
    trunk_.region = region;
    return trunk_;
  }

  /// Makes the root of an empty tree.
  NodeRef createRoot() {
    root_ = createBlock({0, 0, 0}, 0, nullptr);
    create(root_, kRootSlot);
    return root();
  }

  /// Makes child `i`, which must not exist, with the node type's default value.
  NodeRef createChild(NodeRef r, int i) {
    if (r.slot >= kCells) return create(r.block, childOctet(r.slot) * 8 + i);
    const int level = r.block->level() + 1;
    Block* below = findBlock(r.corner(), level);
    if (below == nullptr) below = createBlock(r.corner(), level, r.block);
    return create(below, kTopSlot + i);
  }

  /// Makes nodes of an existing or new octet of a block: `bits` must not exist yet. Returns the octet's nodes.
  NODE* createNodes(Block* block, int number, std::uint8_t bits) {
    return createNodes(block, number, bits, [](void* place, int) { new (place) NODE(); });
  }
  /// The same, node `i` of the octet made by `construct(place, i)`.
  template <class Construct>
  NODE* createNodes(Block* block, int number, std::uint8_t bits, Construct&& construct) {
    touch(block);
    NODE* nodes =
        block->mask[number] == 0 ? nodes_.allocate(nodes_.source(), *block, number) : nodes_.nodes(*block, number);
    for (unsigned rest = bits; rest != 0; rest &= rest - 1)
      construct(static_cast<void*>(nodes + std::countr_zero(rest)), std::countr_zero(rest));
    block->mask[number] = static_cast<std::uint8_t>(block->mask[number] | bits);
    size_ += static_cast<std::size_t>(popcount(bits));
    ++version_;
    return nodes;
  }

  /// Makes children `bits` of a node that has none. The octet, as (block, number).
  NodeRef createChildren(NodeRef r, std::uint8_t bits) {
    const bool below = r.slot < kCells;
    Block* block = below ? createBlock(r.corner(), r.block->level() + 1, r.block) : r.block;
    const int number = below ? kTopOctet : childOctet(r.slot);
    createNodes(block, number, bits);
    return {block, number};
  }

  /// Makes the block below a childless cell of an upper block; the caller makes nodes in it at once.
  Block* createBlockBelow(NodeRef cell) { return createBlock(cell.corner(), cell.block->level() + 1, cell.block); }

  /// Editors for as many threads, which will work on no more than `regions` regions.
  std::vector<RegionEditor<NODE>> editors(std::size_t threads, std::size_t regions) {
    std::vector<RegionEditor<NODE>> editors;
    for (auto& source : nodes_.reserve(threads, regions * kOctets)) editors.emplace_back(nodes_, source);
    return editors;
  }
  /// For one thread.
  RegionEditor<NODE> editor() { return {nodes_, nodes_.source()}; }
  /// Takes over what an editor has done; the caller calls touch() for the regions that it has changed.
  void takeOver(const RegionEditor<NODE>& editor) {
    size_ += static_cast<std::size_t>(editor.made());
    ++version_;
  }

  /// Removes a node without children.
  void remove(NodeRef r) { removeNodes(r.block, r.slot >> 3, static_cast<std::uint8_t>(1U << (r.slot & 7))); }

  /// Removes childless nodes of one octet, and the block with them if nothing is left in it.
  void removeNodes(Block* block, int number, std::uint8_t bits) {
    touch(block);
    NODE* nodes = nodes_.nodes(*block, number);
    for (unsigned rest = bits; rest != 0; rest &= rest - 1) nodes[std::countr_zero(rest)].~NODE();
    block->mask[number] = static_cast<std::uint8_t>(block->mask[number] & ~bits);
    size_ -= static_cast<std::size_t>(popcount(bits));
    ++version_;
    if (block->mask[number] != 0) return;
    nodes_.release(nodes_.source(), *block, number);
    const bool was_last = number == kTopOctet || (block == root_ && number == kRootSlot >> 3);
    if (!was_last) return;
    index_.erase(block->key);
    nodes_.leave(*block);
    blocks_.release(block);
    if (block == trunk_.region) trunk_.region = nullptr;
    if (block == root_) root_ = nullptr;
  }

  /// Removes a node and all below it.
  void removeSubtree(NodeRef r) {
    if (const NodeRef o = childOctetOf(r)) {
      for (int i = 0; i < 8; ++i)
        if (o.block->mask[o.slot] >> i & 1) {
          const bool last = (o.block->mask[o.slot] >> i) == 1;
          removeSubtree({o.block, o.slot * 8 + i});
          if (last) break;  // the block may be gone
        }
    }
    remove(r);
  }

  void clear() {
    touchAll();
    index_.forEach([&](Block& block) {
      for (int o = 0; o < kOctets; ++o)
        if (block.mask[o] != 0) destroyOctet(octet(&block, o));
    });
    index_.clear();
    blocks_.clear();
    nodes_.clear();
    pieces_.clear();
    trunk_.region = nullptr;
    root_ = nullptr;
    size_ = 0;
    ++version_;
  }

  /// Makes this empty store a copy of another.
  void copyFrom(const BlockStore& other) {
    if (other.empty()) return;
    copyBlock(other, *other.root_, nullptr);
    root_ = findBlock({0, 0, 0}, 0);
    size_ = other.size_;
  }

  /// The same nodes, with equal values.
  bool operator==(const BlockStore& other) const {
    return size_ == other.size_ && index_.all([&](const Block& a) {
      const Block* b = other.findBlock(a.key);
      if (b == nullptr || a.mask != b->mask) return false;
      for (int o = 0; o < kOctets; ++o)
        if (a.mask[o] != 0 && !equal(octet(&a, o), other.octet(b, o).nodes)) return false;
      return true;
    });
  }

  // --- being observed ---

  /// To be called where values of existing nodes change; making and removing nodes calls it by itself.
  void touch(Block* block) {
    if (!journal_.isNoted(block->stamp)) journal_.note(block->key, block->stamp, index_.size());
  }
  /// To be called where values change in very many blocks.
  void touchAll() { journal_.noteAll(); }

  /// From now on changes are noted for this observer; what it takes first is everything.
  BlockObserver observe() const { return journal_.observe(); }
  /// What has changed since this observer of this store last asked.
  BlockChanges takeChanges(const BlockObserver& observer) const { return journal_.take(observer, index_.size()); }
  /// For stores that change places: lets each observer stay at its place, where everything has changed then.
  void swapObservers(BlockStore& other) { journal_.swapObservers(other.journal_); }

  std::size_t memoryUsage() const { return nodes_.memoryUsage() + blocks_.memoryUsage() + index_.memoryUsage(); }

  /// Visits all blocks, in no particular order.
  template <class F>
  void forEachBlock(F&& visit) const {
    index_.forEach(visit);
  }

 private:
  /// For nodes on their own: the children of the node that has this address inside it.
  static NodeChildren childrenAround(const void* store, const void* node) {
    const Octet<NODE> octet = static_cast<const BlockStore*>(store)->children(OctetPool<NODE>::locate(node));
    return {octet.nodes, sizeof(NODE), octet.mask};
  }

  static void destroyOctet(Octet<NODE> o) {
    if constexpr (!std::is_trivially_destructible_v<NODE>)
      for (unsigned i = 0; i < 8; ++i)
        if (o.has(i)) o.nodes[i].~NODE();
  }

  static bool equal(const Octet<NODE>& a, const NODE* b) {
    bool equal = true;
    for (unsigned rest = a.mask; rest != 0; rest &= rest - 1)
      equal = equal && a.nodes[std::countr_zero(rest)] == b[std::countr_zero(rest)];
    return equal;
  }

  NodeRef create(Block* block, int slot) {
    createNodes(block, slot >> 3, static_cast<std::uint8_t>(1U << (slot & 7)));
    return {block, slot};
  }

  Block* createBlock(const OcTreeKey& corner, int level, Block* parent) {
    auto* block = static_cast<Block*>(blocks_.allocate());
    block->mask.fill(0);
    block->refs.fill(0);  // who asks for the memory of octets need not know which of them exist
    block->key = blockKey(corner, level);
    block->stamp = 0;
    block->parent = parent;
    nodes_.enter(*block);
    index_.insert(block->key, block);
    return block;
  }

  void copyBlock(const BlockStore& other, const Block& from, Block* parent) {
    Block* to = createBlock(from.corner(), from.level(), parent);
    for (int o = 0; o < kOctets; ++o) {
      if (from.mask[o] == 0) continue;
      const Octet<NODE> source = other.octet(&from, o);
      createNodes(to, o, source.mask, [&](void* place, int i) { new (place) NODE(source.nodes[i]); });
    }
    if (from.level() == kRegionLevel) return;
    for (int cell = 0; cell < kCells; ++cell)
      if (from.has(cell))
        if (const Block* below = other.findBlock(from.cornerOf(cell), from.level() + 1)) copyBlock(other, *below, to);
  }

  BlockIndex<Block> index_;
  PiecePool pieces_;
  RecordPool blocks_{pieces_, {.bytes = sizeof(Block)}};
  OctetPool<NODE> nodes_{pieces_, this, childrenAround};
  Block* root_ = nullptr;
  Trunk<NODE> trunk_;
  const Block* last_changed_ = nullptr;  // to compare with, no more: it may be gone
  std::size_t size_ = 0;
  std::uint64_t version_ = 0;
  mutable BlockJournal journal_;  // who observes is no part of the map
};

}  // namespace rhmap
