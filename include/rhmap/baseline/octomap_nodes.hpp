// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#ifdef RHMAP_COMPAT_OCTOMAP
#error \
    "rhmap's bridges need OctoMap's own OcTree: include them in a source file that is not compiled with rhmap::compat."
#endif

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rhmap/octree/occupancy_octree_base.hpp"

/// Writes the nodes of a map into a stock octomap::OcTree, block by block. What is in the tree already is changed in
/// place: a node that stays keeps its address. What the bridge and the mirror are made of.
namespace rhmap::octomap_nodes {

/// Log-odds of hits and misses, the clamping and the threshold, to the bit; and the resolution.
void copyModel(const AbstractOccupancyOcTree& from, octomap::OcTree& to);

/// The root, made if there is none.
octomap::OcTreeNode* makeRoot(octomap::OcTree& tree);

/// The child, or null.
octomap::OcTreeNode* child(const octomap::OcTree& tree, octomap::OcTreeNode* node, unsigned i);

/// The node of exactly this depth around a key, or null.
octomap::OcTreeNode* find(const octomap::OcTree& tree, const OcTreeKey& key, unsigned depth);

/// Gives a node the children in `mask` and no others. Those that it had and keeps are left as they are, those that it
/// loses go with all below them.
void shapeChildren(octomap::OcTree& tree, octomap::OcTreeNode* node, std::uint8_t mask);

/// Makes an octet of a block, the children of `above`, what it is in the map.
template <class NODE>
void writeOctet(const BlockStore<NODE>& store, const Block& block, int number, octomap::OcTree& tree,
                octomap::OcTreeNode* above) {
  const std::uint8_t mask = block.mask[static_cast<std::size_t>(number)];
  shapeChildren(tree, above, mask);
  if (mask == 0) return;
  const NODE* nodes = store.octet(&block, number).nodes;
  for (unsigned rest = mask; rest != 0; rest &= rest - 1) {
    const int i = std::countr_zero(rest);
    tree.getNodeChild(above, static_cast<unsigned>(i))->setLogOdds(nodes[i].getLogOdds());
  }
}

/// Visits the existing nodes of octet `number` of a block in both trees: (slot, node).
template <class F>
void forEachIn(const Block& block, int number, const octomap::OcTree& tree, octomap::OcTreeNode* above, F&& visit) {
  for (unsigned rest = block.mask[static_cast<std::size_t>(number)]; rest != 0; rest &= rest - 1) {
    const int i = std::countr_zero(rest);
    visit(number * 8 + i, tree.getNodeChild(above, static_cast<unsigned>(i)));
  }
}

/// Calls `visit(octet number, node above it)` for all octets of a block that could exist, from above.
template <class F>
void forEachOctet(const Block& block, octomap::OcTree& tree, octomap::OcTreeNode* above, F&& visit) {
  if (block.level() == 0) return visit(childOctet(kRootSlot), above);  // the root itself is not in an octet there
  visit(kTopOctet, above);
  forEachIn(block, kTopOctet, tree, above, [&](int top, octomap::OcTreeNode* top_node) {
    visit(childOctet(top), top_node);
    forEachIn(block, childOctet(top), tree, top_node,
              [&](int middle, octomap::OcTreeNode* middle_node) { visit(childOctet(middle), middle_node); });
  });
}

/// Makes the nodes of a block what they are in the map. `above`: the node above the block; the root for the root's.
/// What is below the block's cells stays.
template <class NODE>
void writeBlock(const BlockStore<NODE>& store, const Block& block, octomap::OcTree& tree, octomap::OcTreeNode* above) {
  if (block.level() == 0) above->setLogOdds(store.node(store.root())->getLogOdds());
  forEachOctet(block, tree, above,
               [&](int octet, octomap::OcTreeNode* node) { writeOctet(store, block, octet, tree, node); });
}

/// writeBlock() for a block and all below. Returns the number of blocks.
template <class NODE>
std::size_t writeBlocksBelow(const BlockStore<NODE>& store, const Block& block, octomap::OcTree& tree,
                             octomap::OcTreeNode* above) {
  writeBlock(store, block, tree, above);
  std::size_t blocks = 1;
  if (block.level() == kRegionLevel) return blocks;
  forEachOctet(block, tree, above, [&](int octet, octomap::OcTreeNode* node) {
    if (octet >= kMiddleOctet) return;
    forEachIn(block, octet, tree, node, [&](int cell, octomap::OcTreeNode* cell_node) {
      const Block* below = store.findBlock(block.cornerOf(cell), block.level() + 1);
      if (below != nullptr) {
        blocks += writeBlocksBelow(store, *below, tree, cell_node);
      } else {
        shapeChildren(tree, cell_node, 0);
      }
    });
  });
  return blocks;
}

/// Makes the tree what the map is. Returns the number of blocks.
template <class NODE>
std::size_t writeAll(const BlockStore<NODE>& store, octomap::OcTree& tree) {
  if (store.empty()) {
    tree.clear();
    return 0;
  }
  return writeBlocksBelow(store, *store.root().block, tree, makeRoot(tree));
}

/// Makes the tree what the map is where these blocks (ascending keys, of blocks that are there or that are gone) are
/// all that differ. Returns the number of blocks rewritten; nothing if the tree turns out to differ elsewhere, too.
template <class NODE>
std::optional<std::size_t> writeChanged(const BlockStore<NODE>& store, const std::vector<std::uint64_t>& blocks,
                                        octomap::OcTree& tree) {
  if (store.empty()) return writeAll(store, tree);
  std::size_t written = 0;
  for (const std::uint64_t key : blocks) {
    const int level = blockLevel(key);
    const Block* block = store.findBlock(key);
    octomap::OcTreeNode* above =
        level == 0 ? makeRoot(tree) : find(tree, blockCorner(key), static_cast<unsigned>(3 * level - 2));
    if (block != nullptr) {
      if (above == nullptr) return std::nullopt;
      writeBlock(store, *block, tree, above);
      ++written;
    } else if (above != nullptr) {
      shapeChildren(tree, above, 0);
      ++written;
    }
  }
  if (tree.size() != store.size()) return std::nullopt;  // somebody else has been at it
  return written;
}

}  // namespace rhmap::octomap_nodes
