// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/terrain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "rhmap/sim/shape.hpp"

namespace rhmap::sim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// z = c + a u + b v over the cell, with u and v from 0 to 1 in it.
struct Plane {
  double c = 0, a = 0, b = 0;
};

/// The two triangles of a cell meet on its diagonal u = v; the first has u >= v.
std::array<Plane, 2> planesOf(const HeightGrid& grid, std::size_t column, std::size_t row) {
  const auto at = [&](std::size_t x, std::size_t y) { return grid.heights[(row + y) * grid.columns + column + x]; };
  const double h00 = at(0, 0), h10 = at(1, 0), h01 = at(0, 1), h11 = at(1, 1);
  return {{{h00, h10 - h00, h11 - h10}, {h00, h11 - h01, h01 - h00}}};
}

/// Which cell, and where in it.
struct Spot {
  std::size_t column = 0, row = 0;
  double u = 0, v = 0;
};

Spot spotOf(const HeightGrid& grid, double x, double y) {
  const auto split = [&](double value, std::size_t count, std::size_t& cell) {
    cell = static_cast<std::size_t>(std::clamp(std::floor(value), 0.0, static_cast<double>(count - 2)));
    return value - static_cast<double>(cell);
  };
  Spot spot;
  spot.u = split((x - grid.corner.x()) / grid.cell, grid.columns, spot.column);
  spot.v = split((y - grid.corner.y()) / grid.cell, grid.rows, spot.row);
  return spot;
}

}  // namespace

void Terrain::setHeights(HeightGrid grid) {
  if (grid.columns < 2 || grid.rows < 2 || !(grid.cell > 0) || grid.heights.size() != grid.columns * grid.rows)
    throw std::invalid_argument("Terrain: a height grid needs 2 x 2 heights or more and as many as it says");
  for (std::size_t i = 0; i < grid.heights.size(); ++i) {
    const std::size_t x = i % grid.columns, y = i / grid.columns;
    const bool border = x == 0 || y == 0 || x + 1 == grid.columns || y + 1 == grid.rows;
    if (border && grid.heights[i] != 0) throw std::invalid_argument("Terrain: a height grid is 0 along its border");
  }
  grid_ = std::move(grid);
}

bool Terrain::inGrid(double x, double y) const {
  if (grid_.heights.empty()) return false;
  const double u = (x - grid_.corner.x()) / grid_.cell, v = (y - grid_.corner.y()) / grid_.cell;
  return u >= 0 && v >= 0 && u <= static_cast<double>(grid_.columns - 1) && v <= static_cast<double>(grid_.rows - 1);
}

double Terrain::height(double x, double y) const {
  if (!inGrid(x, y)) return 0;
  const Spot spot = spotOf(grid_, x, y);
  const Plane plane = planesOf(grid_, spot.column, spot.row)[spot.u >= spot.v ? 0 : 1];
  return plane.c + plane.a * spot.u + plane.b * spot.v;
}

Vector3d Terrain::normal(double x, double y) const {
  if (!inGrid(x, y)) return Vector3d::UnitZ();
  const Spot spot = spotOf(grid_, x, y);
  const Plane plane = planesOf(grid_, spot.column, spot.row)[spot.u >= spot.v ? 0 : 1];
  return Vector3d(-plane.a / grid_.cell, -plane.b / grid_.cell, 1).normalized();
}

Class Terrain::classAt(double x, double y) const {
  for (auto patch = patches_.rbegin(); patch != patches_.rend(); ++patch) {
    const double dx = x - patch->centre.x(), dy = y - patch->centre.y();
    const double c = std::cos(patch->yaw), s = std::sin(patch->yaw);
    if (std::abs(c * dx + s * dy) <= patch->half.x() && std::abs(c * dy - s * dx) <= patch->half.y()) return patch->cls;
  }
  return cls_;
}

double Terrain::hitDistance(const Vector3d& origin, const Vector3d& direction, double max_range) const {
  double nearest = kNoHit;
  if (direction.z() < 0 && origin.z() >= 0) {
    const double t = -origin.z() / direction.z();
    if (!inGrid(origin.x() + t * direction.x(), origin.y() + t * direction.y())) nearest = t;
  }
  if (!grid_.heights.empty()) nearest = std::min(nearest, hitGrid(origin, direction, std::min(nearest, max_range)));
  return nearest <= max_range ? nearest : kNoHit;
}

/// Goes from cell to cell along the ray; a cell has a hit where the ray is over a triangle and meets its plane.
double Terrain::hitGrid(const Vector3d& origin, const Vector3d& direction, double max_range) const {
  // The ray in cells: position p + t d, t in metres.
  const Vector2d p = (origin.head<2>() - grid_.corner) / grid_.cell;
  const Vector2d d = direction.head<2>() / grid_.cell;
  const double limit[2] = {static_cast<double>(grid_.columns - 1), static_cast<double>(grid_.rows - 1)};
  double t = 0, t_end = max_range;
  for (int axis = 0; axis < 2; ++axis) {
    if (d[axis] == 0) {
      if (p[axis] < 0 || p[axis] > limit[axis]) return kNoHit;
      continue;
    }
    const double a = -p[axis] / d[axis], b = (limit[axis] - p[axis]) / d[axis];
    t = std::max(t, std::min(a, b));
    t_end = std::min(t_end, std::max(a, b));
  }
  if (t > t_end) return kNoHit;

  constexpr double kEdge = 1e-9;  // a ray along an edge belongs to both sides
  const auto clampCell = [&](double value, int axis) { return std::clamp(std::floor(value), 0.0, limit[axis] - 1); };
  double cell[2] = {clampCell(p.x() + t * d.x(), 0), clampCell(p.y() + t * d.y(), 1)};
  while (true) {
    double leave[2];
    for (int axis = 0; axis < 2; ++axis)
      leave[axis] = d[axis] == 0 ? kNoHit : ((d[axis] > 0 ? cell[axis] + 1 : cell[axis]) - p[axis]) / d[axis];
    const double t_leave = std::min({leave[0], leave[1], t_end});
    const auto planes = planesOf(grid_, static_cast<std::size_t>(cell[0]), static_cast<std::size_t>(cell[1]));
    double nearest = kNoHit;
    for (int side = 0; side < 2; ++side) {
      const Plane& plane = planes[static_cast<std::size_t>(side)];
      const double u = p.x() - cell[0], v = p.y() - cell[1];
      const double falling = plane.a * d.x() + plane.b * d.y() - direction.z();  // how fast the ground comes up
      if (falling <= 0) continue;                                                // from below, or never
      const double hit = (origin.z() - plane.c - plane.a * u - plane.b * v) / falling;
      if (hit < t - kEdge || hit > t_leave + kEdge) continue;
      const double over = (u + hit * d.x()) - (v + hit * d.y());
      if (side == 0 ? over >= -kEdge : over <= kEdge) nearest = std::min(nearest, std::max(hit, 0.0));
    }
    if (nearest != kNoHit) return nearest;
    if (t_leave >= t_end) return kNoHit;
    const int axis = leave[0] <= leave[1] ? 0 : 1;
    cell[axis] += d[axis] > 0 ? 1 : -1;
    if (cell[axis] < 0 || cell[axis] >= limit[axis]) return kNoHit;
    t = t_leave;
  }
}

}  // namespace rhmap::sim
