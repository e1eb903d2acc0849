// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "rhmap/core/block_store.hpp"

/// OctoMap's rules for the structure of the tree: when eight leaves become one, and how one becomes eight again.
namespace rhmap::structure {

/// The eight nodes of an octet (block and number) exist, are leaves and are equal.
template <class NODE>
bool isUniform(const BlockStore<NODE>& store, NodeRef octet) {
  if (octet.block->mask[octet.slot] != 0xff) return false;
  const NODE* node = store.octet(octet.block, octet.slot).nodes;
  for (int i = 1; i < 8; ++i)
    if (!(node[i] == node[0])) return false;
  return !store.anyHasChildren(octet);
}

/// All eight children exist, are leaves and are equal.
template <class NODE>
bool isCollapsible(const BlockStore<NODE>& store, NodeRef at) {
  const NodeRef octet = store.childOctetOf(at);
  return octet && isUniform(store, octet);
}

/// Gives a leaf eight children with its data; a no-op at depth 16.
template <class NODE>
void expand(BlockStore<NODE>& store, NodeRef at) {
  if (at.depth() == kTreeDepth) return;
  const NODE* from = store.node(at);
  const NodeRef o = store.createChildren(at, 0xff);
  NODE* child = store.octet(o.block, o.slot).nodes;
  for (int i = 0; i < 8; ++i) child[i].copyData(*from);
}

/// Replaces the eight nodes of a uniform octet by their parent.
template <class NODE>
void collapse(BlockStore<NODE>& store, NodeRef parent, NodeRef octet) {
  store.touch(parent.block);
  store.node(parent)->copyData(*store.octet(octet.block, octet.slot).nodes);
  store.removeNodes(octet.block, octet.slot, 0xff);
}

/// Replaces eight equal leaves by their parent; false if it is not collapsible.
template <class NODE>
bool prune(BlockStore<NODE>& store, NodeRef at) {
  const NodeRef octet = store.childOctetOf(at);
  if (!octet || !isUniform(store, octet)) return false;
  collapse(store, at, octet);
  return true;
}

/// Leaves a node without children.
template <class NODE>
void removeBelow(BlockStore<NODE>& store, NodeRef at) {
  const NodeRef all = store.childOctetOf(at);
  if (!all) return;
  const std::uint8_t mask = all.block->mask[static_cast<std::size_t>(all.slot)];
  if (!store.anyHasChildren(all)) return store.removeNodes(all.block, all.slot, mask);
  for (int i = 0; i < 8; ++i)
    if (mask >> i & 1) {
      const NodeRef octet = store.childOctetOf(at);
      store.removeSubtree({octet.block, octet.slot * 8 + i});
    }
}

/// The node's class leaves the value of inner nodes to OctoMap's rule, the largest of the children.
template <class NODE>
inline constexpr bool kOctomapsInnerValue = requires(NODE node, Octet<NODE> children) {
  node.updateOccupancyChildren(children);
};

/// Recomputes an inner node from its children, by the rule of its class, if it has one.
template <class NODE>
void recompute(NODE& node, const Octet<NODE>& children) {
  if constexpr (kOctomapsInnerValue<NODE>) {
    node.updateOccupancyChildren(children);
  } else if constexpr (requires { node.updateOccupancyChildren(); }) {
    node.updateOccupancyChildren();
  }
}
template <class NODE>
void recompute(BlockStore<NODE>& store, NodeRef at, const Octet<NODE>& children) {
  store.touch(at.block);
  recompute(*store.node(at), children);
}

/// Recomputes a node from its children, of which `child` is one.
template <class NODE>
void recompute(BlockStore<NODE>& store, NodeRef parent, NodeRef child) {
  recompute(store, parent, store.octet(child.block, child.slot >> 3));
}

/// OctoMap's rule on the way up from a child: eight equal leaves become their parent, else the parent is recomputed
/// from its children. True if it was pruned.
template <class NODE>
bool summarise(BlockStore<NODE>& store, NodeRef parent, NodeRef child) {
  const NodeRef octet{child.block, child.slot >> 3};
  if (isUniform(store, octet)) {
    collapse(store, parent, octet);
    return true;
  }
  recompute(store, parent, child);
  return false;
}

/// recompute() for all nodes above a region, by OctoMap's rule; nodes whose children are what they were the last time
/// get the value that they got then.
template <class NODE>
void recomputeTrunk(BlockStore<NODE>& store, Block* region) {
  const auto bits = [](const NODE* node) { return std::bit_cast<std::uint32_t>(node->getLogOdds()); };
  for (typename Trunk<NODE>::Step& step : store.trunk(region).steps) {
    const std::uint32_t before = bits(step.node);
    if (!step.isAsSeen()) {
      step.node->updateOccupancyChildren(Octet<NODE>{const_cast<NODE*>(step.children), *step.mask});
      step.see(step.node->getLogOdds());
    } else if (before != step.value) {
      step.node->setLogOdds(std::bit_cast<float>(step.value));
    }
    if (bits(step.node) != before) store.touch(step.block);
  }
}

/// summarise() for all ancestors of a node. Returns the highest one that was pruned, if any. `clustered`: it is one of
/// many single changes, which often come one after the other in the same region.
template <class NODE>
NodeRef summariseAbove(BlockStore<NODE>& store, NodeRef child, bool clustered = false) {
  NodeRef pruned;
  bool pruning = true;
  while (const NodeRef parent = store.parent(child)) {
    // The first that keeps its children keeps those above it from being pruned.
    if (pruning) {
      pruning = summarise(store, parent, child);
      if (pruning) pruned = parent;
    } else {
      if constexpr (kOctomapsInnerValue<NODE> && sizeof(NODE) == sizeof(float)) {
        if (clustered && child.slot >= kTopSlot && child.block->level() == kRegionLevel &&
            store.isChangedAgain(child.block)) {
          recomputeTrunk(store, child.block);
          return pruned;
        }
      }
      recompute(store, parent, child);
    }
    child = parent;
  }
  return pruned;
}

/// The child of a node on the way to `key`; empty if there is none.
template <class NODE>
NodeRef childTowards(const BlockStore<NODE>& store, NodeRef at, const OcTreeKey& key) {
  const NodeRef o = store.childOctetOf(at);
  if (!o) return {};
  const int step = o.slot < kMiddleOctet ? 1 : o.slot < kTopOctet ? 0 : -1;
  const int slot = slotAbove(cellIndex(key, o.block->level()), step);
  return o.block->has(slot) ? NodeRef{o.block, slot} : NodeRef{};
}

/// Number of the child on the way to `key`.
inline int childNumber(NodeRef at, const OcTreeKey& key) {
  const unsigned bit = kTreeDepth - 1 - at.depth();
  return (key[0] >> bit & 1) | (key[1] >> bit & 1) << 1 | (key[2] >> bit & 1) << 2;
}

/// Makes the way down to depth `depth` exist, from the deepest node that is there (or none): a pruned leaf is expanded
/// (by `expand(NodeRef)`), a missing node is made with the default value. `fresh` tells whether the node returned is
/// new and not a copy of a pruned leaf; coming in, whether `deepest` is.
template <class NODE, class Expand>
NodeRef reach(BlockStore<NODE>& store, NodeRef deepest, const OcTreeKey& key, unsigned depth, bool& fresh,
              Expand&& expand) {
  NodeRef at = deepest;
  if (!at) {
    at = store.createRoot();
    fresh = true;
  }
  while (at.depth() < depth) {
    if (!fresh && !store.hasChildren(at)) {
      expand(at);
      if (const NodeRef child = childTowards(store, at, key)) {
        at = child;
        continue;
      }
    }
    at = store.createChild(at, childNumber(at, key));
    fresh = true;
  }
  return at;
}

/// See OcTreeBaseImpl::deleteNode.
template <class NODE, class Expand>
bool deleteNode(BlockStore<NODE>& store, const OcTreeKey& key, unsigned depth, Expand&& expand) {
  if (store.empty()) return true;
  NodeRef at = depth == kTreeDepth ? store.deepest(key) : store.root();
  while (at.depth() < depth) {
    if (!store.hasChildren(at)) {
      if (at == store.root()) return false;
      expand(at);
    }
    at = childTowards(store, at, key);
    if (!at) return false;
  }
  NodeRef above = store.parent(at);
  store.removeSubtree(at);
  while (above && !store.hasChildren(above)) {
    if (above == store.root()) return true;  // OctoMap leaves a root without children behind
    at = above;
    above = store.parent(at);
    store.remove(at);
  }
  recompute(store, above, store.children(above));
  return false;
}

/// Blocks of one level. A list, because what is done to them may remove blocks of deeper levels.
template <class NODE>
std::vector<Block*> blocksOfLevel(const BlockStore<NODE>& store, int level) {
  std::vector<Block*> blocks;
  store.forEachBlock([&](Block& block) {
    if (block.level() == level) blocks.push_back(&block);
  });
  return blocks;
}

/// Calls `visit(NodeRef)` for all existing nodes at a depth, in no particular order. It may remove what is below a
/// node.
template <class NODE, class F>
void forEachAtDepth(const BlockStore<NODE>& store, unsigned depth, F&& visit) {
  const int level = static_cast<int>(depth + 1) / 3;
  const int step = static_cast<int>(depth) - 3 * level;
  const int first = slotAbove(0, step);
  const int last = slotAbove(kCells - 1, step);
  for (Block* block : blocksOfLevel(store, level))
    for (int slot = first; slot <= last; ++slot)
      if (block->has(slot)) visit(NodeRef{block, slot});
}

/// See OcTreeBaseImpl::prune. `prune(NodeRef)` tells whether it pruned.
template <class NODE, class Prune>
void pruneLevels(BlockStore<NODE>& store, Prune&& prune) {
  for (unsigned depth = kTreeDepth - 1; depth > 0; --depth) {
    std::size_t pruned = 0;
    forEachAtDepth(store, depth, [&](NodeRef at) { pruned += prune(at); });
    if (pruned == 0) break;
  }
}

/// Expands every leaf down to depth 16.
template <class NODE, class Expand>
void expandAll(BlockStore<NODE>& store, Expand&& expand) {
  for (unsigned depth = 0; depth < kTreeDepth; ++depth)
    forEachAtDepth(store, depth, [&](NodeRef at) {
      if (!store.hasChildren(at)) expand(at);
    });
}

/// Recomputes every inner node from its children, bottom up: the cells of upper blocks, which are above other blocks,
/// then what is above them in their own.
template <class NODE>
void updateInner(BlockStore<NODE>& store) {
  store.touchAll();  // leaves, too: who wrote into nodes by hand calls this afterwards
  const auto update = [&](Block* block, int slot) {
    if (!block->has(slot)) return;
    if (const Octet<NODE> children = store.children({block, slot}); children.mask != 0)
      recompute(*store.node({block, slot}), children);
  };
  for (int level = kRegionLevel; level >= 0; --level)
    for (Block* block : blocksOfLevel(store, level))
      for (int step = level == kRegionLevel ? 0 : 1; step >= -1; --step)
        for (int slot = slotAbove(0, step); slot <= slotAbove(kCells - 1, step); ++slot) update(block, slot);
}

}  // namespace rhmap::structure
