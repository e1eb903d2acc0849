// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "rhmap/octree/color_octree.hpp"
#include "rhmap/render/colour.hpp"

namespace rhmap::render {

/// What a ramp of colours goes over.
struct Range {
  double min = 0;
  double max = 1;

  /// Where a value is in the range: 0 at its minimum, 1 at its maximum.
  double place(double value) const { return max > min ? (value - min) / (max - min) : 0; }
};

/// What nearly all occupied leaves lie in [m]: the lowest and the highest fiftieth, birds and pits, do not stretch the
/// ramp. Leaves above `ceiling` [m] do not count; {0, 1} for a map without any.
template <class TREE>
Range heightRange(const TREE& tree, double ceiling = std::numeric_limits<double>::infinity()) {
  std::vector<float> heights;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf)
    if (tree.isNodeOccupied(*leaf) && leaf.getZ() < ceiling) heights.push_back(static_cast<float>(leaf.getZ()));
  if (heights.empty()) return {};
  const auto quantile = [&](double q) {
    const auto nth = heights.begin() + static_cast<std::ptrdiff_t>(q * double(heights.size() - 1));
    std::nth_element(heights.begin(), nth, heights.end());
    return double(*nth);
  };
  const double min = quantile(0.02);
  return {min, std::max(quantile(0.98), min + tree.getResolution())};
}

// Colourings of occupied leaves, for occupiedFaces(): each takes a leaf iterator.

/// By the height of the leaf's centre [m].
inline auto byHeight(Range range) {
  return [range](const auto& leaf) { return rampColour(range.place(leaf.getZ())); };
}

/// By the probability of being occupied, over this range.
inline auto byOccupancy(Range range = {0.5, 1}) {
  return [range](const auto& leaf) { return rampColour(range.place(leaf->getOccupancy())); };
}

/// By the colour that a ColorOcTree has for the leaf; white where it has none.
inline auto byOwnColour() {
  return [](const auto& leaf) {
    const ColorOcTreeNode::Color colour = leaf->getColor();
    return Colour{colour.r, colour.g, colour.b};
  };
}

}  // namespace rhmap::render
