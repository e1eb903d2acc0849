// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>

#include "load_map.hpp"
#include "moving_cells.hpp"
#include "rhmap/render/caption.hpp"
#include "rhmap/render/scene.hpp"

namespace rhmap::tools {

/// A map ready to be drawn, and what its colours mean.
struct ColouredMap {
  render::FaceMesh faces;
  std::vector<render::LegendEntry> entries;
  std::vector<render::LegendRamp> ramps;
};

// What begins above `ceiling` [m] is left out.
inline constexpr double kNoCeiling = std::numeric_limits<double>::infinity();

ColouredMap colouredByHeight(const AbstractOccupancyOcTree& map, double ceiling = kNoCeiling);
ColouredMap colouredByOccupancy(const AbstractOccupancyOcTree& map, double ceiling = kNoCeiling);

/// By the colours that the tree's own nodes carry; nothing if it is no ColorOcTree.
std::optional<ColouredMap> colouredByItself(const AbstractOccupancyOcTree& map, double ceiling = kNoCeiling);

/// What is left of what moved in red, the rest grey.
ColouredMap colouredByResidue(const AbstractOccupancyOcTree& map, const KeySet& moving, double ceiling = kNoCeiling);

/// Cells of the ground, and what stands on it.
ColouredMap colouredByGround(const AbstractOccupancyOcTree& map, const KeySet& ground, double ceiling = kNoCeiling);

/// The occupied cells of `before` by what became of them in `after`: kept or removed. With `moving` also whether that
/// was right: moving ones are removed or missed, static ones kept or lost. A leaf of several cells counts as kept, and
/// as moving, if one of them is. Both maps must have the same resolution; std::invalid_argument otherwise.
ColouredMap colouredByDifference(const AbstractOccupancyOcTree& before, const AbstractOccupancyOcTree& after,
                                 const KeySet* moving, double ceiling = kNoCeiling);

/// The hull of the free space.
render::FaceMesh freeSpace(const AbstractOccupancyOcTree& map);

}  // namespace rhmap::tools
