// SPDX-License-Identifier: BSD-3-Clause
#include "tree_reader.hpp"

#include <algorithm>

namespace rhmap {
namespace {

constexpr unsigned kOctantDepth = 14;

struct Reading {
  const BlockStore<OcTreeNode>& store;
  float occupied_from;
  int x, y, size;
  std::vector<CubesAt> cubes;

  bool isOccupied(const OcTreeNode& node) const { return node.getLogOdds() >= occupied_from; }

  /// `at` holds the cells from `corner` on.
  void below(NodeRef at, const OcTreeKey& corner, unsigned depth) {
    const NodeRef octet = store.childOctetOf(at);
    if (!octet) {
      if (isOccupied(*store.node(at))) addAll(corner, 1 << (kTreeDepth - depth));
      return;
    }
    if (depth == kOctantDepth) {
      if (const std::uint64_t bits = bitsBelow(octet); bits != 0) cubes.push_back({corner, bits});
      return;
    }
    const int half = 1 << (kTreeDepth - 1 - depth);
    forEachBit(octet.block->mask[static_cast<std::size_t>(octet.slot)], [&](int i) {
      const int cx = corner[0] + (i & 1 ? half : 0), cy = corner[1] + (i & 2 ? half : 0);
      if (cx + half <= x || cx >= x + size || cy + half <= y || cy >= y + size) return;
      const OcTreeKey part(static_cast<key_type>(cx), static_cast<key_type>(cy),
                           static_cast<key_type>(corner[2] + (i & 4 ? half : 0)));
      below({octet.block, octet.slot * 8 + i}, part, depth + 1);
    });
  }

  /// The occupied cells below an octet of depth 15.
  std::uint64_t bitsBelow(NodeRef octet) const {
    const Octet<OcTreeNode> middles = store.octet(octet.block, octet.slot);
    std::uint64_t bits = 0;
    forEachBit(middles.mask, [&](int i) {
      const Octet<OcTreeNode> cells = store.children({octet.block, octet.slot * 8 + i});
      std::uint64_t occupied = cells.mask == 0 && isOccupied(middles.nodes[i]) ? 0xff : 0;
      forEachBit(cells.mask, [&](int cell) { occupied |= std::uint64_t{isOccupied(cells.nodes[cell])} << cell; });
      bits |= occupied << 8 * i;
    });
    return bits;
  }

  /// The octants of an occupied leaf of so many cells an edge, 4 or more.
  void addAll(const OcTreeKey& corner, int edge) {
    for (int z = corner[2]; z < corner[2] + edge; z += 4)
      for (int cy = std::max<int>(corner[1], y); cy < std::min(corner[1] + edge, y + size); cy += 4)
        for (int cx = std::max<int>(corner[0], x); cx < std::min(corner[0] + edge, x + size); cx += 4)
          cubes.push_back(
              {{static_cast<key_type>(cx), static_cast<key_type>(cy), static_cast<key_type>(z)}, ~std::uint64_t{0}});
  }
};

}  // namespace

std::vector<CubesAt> readColumn(const BlockStore<OcTreeNode>& tree, float occupied_from, key_type x, key_type y,
                                int size) {
  Reading reading{tree, occupied_from, x, y, size, {}};
  if (const NodeRef root = tree.root()) reading.below(root, {0, 0, 0}, 0);
  return std::move(reading.cubes);
}

}  // namespace rhmap
