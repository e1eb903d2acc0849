// SPDX-License-Identifier: BSD-3-Clause
#include "tree_reader.hpp"

namespace rhmap {
namespace {

constexpr unsigned kOctantDepth = 14;

/// The occupied cells below a node of depth 14 or more, as bits.
std::uint64_t bitsBelow(const OcTree& tree, const OcTreeNode* node, unsigned depth) {
  const unsigned cells = 1U << 3 * (kTreeDepth - depth);
  if (!tree.nodeHasChildren(node)) return tree.isNodeOccupied(node) ? ~std::uint64_t{0} >> (64 - cells) : 0;
  std::uint64_t bits = 0;
  for (unsigned i = 0; i < 8; ++i) {
    if (tree.nodeChildExists(node, i))
      bits |= bitsBelow(tree, tree.getNodeChild(node, i), depth + 1) << (i * cells / 8);
  }
  return bits;
}

struct Reading {
  const OcTree& tree;
  key_type x, y;
  int size;
  std::vector<CubesAt> cubes;

  /// `node` holds the cells from `corner` on; it may be a leaf above this depth.
  void below(const OcTreeNode* node, const OcTreeKey& corner, unsigned depth) {
    const bool leaf = !tree.nodeHasChildren(node);
    if (leaf && !tree.isNodeOccupied(node)) return;
    if (depth == kOctantDepth) {
      const std::uint64_t bits = leaf ? ~std::uint64_t{0} : bitsBelow(tree, node, depth);
      if (bits != 0) cubes.push_back({corner, bits});
      return;
    }
    const int half = 1 << (kTreeDepth - 1 - depth);
    for (unsigned i = 0; i < 8; ++i) {
      const int cx = corner[0] + (i & 1 ? half : 0), cy = corner[1] + (i & 2 ? half : 0);
      if (cx + half <= x || cx >= x + size || cy + half <= y || cy >= y + size) continue;
      const OcTreeKey part(static_cast<key_type>(cx), static_cast<key_type>(cy),
                           static_cast<key_type>(corner[2] + (i & 4 ? half : 0)));
      if (leaf) {
        below(node, part, depth + 1);
      } else if (tree.nodeChildExists(node, i)) {
        below(tree.getNodeChild(node, i), part, depth + 1);
      }
    }
  }
};

}  // namespace

std::vector<CubesAt> readColumn(const OcTree& tree, key_type x, key_type y, int size) {
  Reading reading{tree, x, y, size, {}};
  if (const OcTreeNode* root = tree.getRoot()) reading.below(root, {0, 0, 0}, 0);
  return std::move(reading.cubes);
}

}  // namespace rhmap
