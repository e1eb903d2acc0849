// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cell_map.hpp"

namespace rhmap::eval {

inline double squaredDistance(const octomap::point3d& a, const octomap::point3d& b) {
  const double x = static_cast<double>(a.x()) - b.x();
  const double y = static_cast<double>(a.y()) - b.y();
  const double z = static_cast<double>(a.z()) - b.z();
  return x * x + y * y + z * z;
}

/// Points sorted into cells, for neighbours within a radius that is not much larger than a cell. The points must live
/// as long as the grid.
///
/// Not a k-d tree: nanoflann's gives the same scores, in 0.9 of the time for protocol kth, but takes twice as long for
/// erasor, which wants a new index for each scan; and what adapts it to rims, ties and visitors is as long as this.
class PointGrid {
 public:
  struct Neighbour {
    std::uint32_t index = 0;
    double squared_distance = 0;
  };

  PointGrid(std::span<const octomap::point3d> points, double edge) : points_(points), grid_(edge) {
    std::vector<std::uint32_t> cell_of(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) cell_of[k] = cells_.findOrAdd(grid_.cellOf(points[k]));
    begins_.assign(cells_.size() + 1, 0);
    for (const std::uint32_t cell : cell_of) ++begins_[cell + 1];
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) begins_[cell + 1] += begins_[cell];
    order_.resize(points.size());
    std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
    for (std::size_t k = 0; k < points.size(); ++k) order_[next[cell_of[k]]++] = static_cast<std::uint32_t>(k);
  }

  /// Calls visit(index, squared distance) for every point within `radius` [m] of `query`, its rim included.
  template <class Visit>
  void forEachWithin(const octomap::point3d& query, double radius, Visit visit) const {
    forEachCell(query, radius, [&](std::uint32_t cell) { visitCell(cell, query, radius * radius, visit); });
  }

  /// The nearest point within `radius` [m], its rim included; of equally near ones that with the smallest index.
  std::optional<Neighbour> nearest(const octomap::point3d& query, double radius) const {
    std::optional<Neighbour> best;
    const auto keepBest = [&best](std::uint32_t index, double squared) {
      if (!best || squared < best->squared_distance || (squared == best->squared_distance && index < best->index))
        best = Neighbour{index, squared};
    };
    // The query's own cell mostly has a near one, and then few others are worth a look.
    const std::uint32_t own = cells_.find(grid_.cellOf(query));
    if (own != CellMap::kNone) visitCell(own, query, radius * radius, keepBest);
    forEachWithin(query, best ? std::sqrt(best->squared_distance) : radius, keepBest);
    return best;
  }

 private:
  template <class Visit>
  void forEachCell(const octomap::point3d& query, double radius, Visit visit) const {
    const double reach = radius + 1e-9;  // rounding must not hide a point on the rim
    const Cell low = grid_.cellOf(query, -reach), high = grid_.cellOf(query, reach);
    for (std::int64_t x = low.x; x <= high.x; ++x) {
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        for (std::int64_t z = low.z; z <= high.z; ++z) {
          const std::uint32_t cell = cells_.find({x, y, z});
          if (cell != CellMap::kNone) visit(cell);
        }
      }
    }
  }

  template <class Visit>
  void visitCell(std::uint32_t cell, const octomap::point3d& query, double squared_radius, Visit& visit) const {
    for (std::uint32_t k = begins_[cell]; k < begins_[cell + 1]; ++k) {
      const double squared = squaredDistance(points_[order_[k]], query);
      if (squared <= squared_radius) visit(order_[k], squared);
    }
  }

  std::span<const octomap::point3d> points_;
  CellGrid grid_;
  CellMap cells_;
  std::vector<std::uint32_t> begins_;  // of the points of a cell in order_
  std::vector<std::uint32_t> order_;
};

}  // namespace rhmap::eval
