// SPDX-License-Identifier: BSD-3-Clause
#include "map_picture.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "rhmap/render/colouring.hpp"

namespace rhmap::tools {
namespace {

using render::Colour;
using render::occupiedFaces;

bool occupiedIn(const AbstractOccupancyOcTree& map, const OcTreeKey& key, unsigned depth) {
  return visitTree(map, [&](const auto& tree) {
    const auto* node = tree.search(key, depth);
    return node != nullptr && tree.isNodeOccupied(node);
  });
}

/// Leaves that hold one of the cells in one colour, the others in another.
ColouredMap colouredByCells(const AbstractOccupancyOcTree& map, const KeySet& cells, const render::LegendEntry& others,
                            const render::LegendEntry& these, double ceiling) {
  const auto colour = [&](const auto& leaf) {
    return holdsOneOf(cells, leaf.getIndexKey(), leaf.getDepth()) ? these.colour : others.colour;
  };
  return visitTree(map, [&](const auto& tree) {
    return ColouredMap{occupiedFaces(tree, colour, ceiling), {others, these}, {}};
  });
}

}  // namespace

ColouredMap colouredByHeight(const AbstractOccupancyOcTree& map, double ceiling) {
  return visitTree(map, [ceiling](const auto& tree) {
    const render::Range range = render::heightRange(tree, ceiling);
    return ColouredMap{occupiedFaces(tree, render::byHeight(range), ceiling), {}, {{"height", "m", range}}};
  });
}

ColouredMap colouredByOccupancy(const AbstractOccupancyOcTree& map, double ceiling) {
  return visitTree(map, [ceiling](const auto& tree) {
    const render::Range range{tree.getOccupancyThres(), tree.getClampingThresMax()};
    return ColouredMap{occupiedFaces(tree, render::byOccupancy(range), ceiling), {}, {{"occupancy", "", range}}};
  });
}

std::optional<ColouredMap> colouredByItself(const AbstractOccupancyOcTree& map, double ceiling) {
  const auto* tree = dynamic_cast<const ColorOcTree*>(&map);
  if (tree == nullptr) return std::nullopt;
  return ColouredMap{occupiedFaces(*tree, render::byOwnColour(), ceiling), {}, {}};
}

ColouredMap colouredByResidue(const AbstractOccupancyOcTree& map, const KeySet& moving, double ceiling) {
  return colouredByCells(map, moving, {render::kKept, "static"}, {render::kMissed, "left of what moved"}, ceiling);
}

ColouredMap colouredByGround(const AbstractOccupancyOcTree& map, const KeySet& ground, double ceiling) {
  return colouredByCells(map, ground, {render::kNonGround, "not ground"}, {render::kGround, "ground"}, ceiling);
}

ColouredMap colouredByDifference(const AbstractOccupancyOcTree& before, const AbstractOccupancyOcTree& after,
                                 const KeySet* moving, double ceiling) {
  if (before.getResolution() != after.getResolution())
    throw std::invalid_argument(fmt::format("maps with cells of {} m and of {} m cannot be compared",
                                            before.getResolution(), after.getResolution()));
  const auto colour = [&](const auto& leaf) -> Colour {
    const bool kept = occupiedIn(after, leaf.getIndexKey(), leaf.getDepth());
    if (moving != nullptr && holdsOneOf(*moving, leaf.getIndexKey(), leaf.getDepth()))
      return kept ? render::kMissed : render::kRemoved;
    if (moving == nullptr) return kept ? render::kKept : render::kRemoved;
    return kept ? render::kKept : render::kLost;
  };
  ColouredMap coloured{
      .faces = visitTree(before, [&](const auto& tree) { return occupiedFaces(tree, colour, ceiling); }),
      .entries = {{render::kKept, "kept"}, {render::kRemoved, "removed"}},
      .ramps = {}};
  if (moving != nullptr)
    coloured.entries = {{render::kKept, "static, kept"},
                        {render::kRemoved, "moving, removed"},
                        {render::kMissed, "moving, missed"},
                        {render::kLost, "static, lost"}};
  return coloured;
}

render::FaceMesh freeSpace(const AbstractOccupancyOcTree& map) {
  return visitTree(map, [](const auto& tree) { return render::freeFaces(tree); });
}

}  // namespace rhmap::tools
