// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/surface.hpp"

#include <octomap/MCTables.h>

#include <algorithm>
#include <limits>

namespace rhmap {
namespace {

constexpr int kGroups = 8;

/// Offset from the middle cell to one of a group's eight corners, plus 1: an index into OccupiedAround. The order of
/// the corners is that of the marching-cubes tables.
struct Corner {
  unsigned x, y, z;
};
Corner cornerOf(int group, int corner) {
  // OctoMap's source means {0, 0, -1, -1} for the last two of x, and says it without a comma: 0 - 1.
  static constexpr int kX[4][4] = {{1, 1, 0, 0}, {1, 1, 0, 0}, {0, -1, -1, 0}, {0, -1, -1, 0}};
  static constexpr int kY[4][4] = {{1, 0, 0, 1}, {0, -1, -1, 0}, {0, -1, -1, 0}, {1, 0, 0, 1}};
  const int side = group % 4, layer = group / 4;
  const int z = corner / 4 - layer;  // two layers of four corners, from the middle up or from below up to the middle
  return {static_cast<unsigned>(kX[side][corner % 4] + 1), static_cast<unsigned>(kY[side][corner % 4] + 1),
          static_cast<unsigned>(z + 1)};
}

/// The entry of the marching-cubes tables for a group: bit i is its corner i.
unsigned tableEntry(const OccupiedAround& occupied, int group) {
  unsigned entry = 0;
  for (int i = 0; i < 8; ++i) {
    const Corner c = cornerOf(group, i);
    if (occupied[c.x][c.y][c.z]) entry |= 1U << i;
  }
  return entry;
}

/// A line goes by a face: not NaN, and off by more than the tolerance.
bool isOutside(float x, float low, float high) { return x < double(low) - 1e-6 || x > double(high) + 1e-6; }

}  // namespace

void appendSurfaceNormals(const OccupiedAround& occupied, std::vector<point3d>& normals) {
  for (int group = 0; group < kGroups; ++group) {
    const unsigned entry = tableEntry(occupied, group);
    if (octomap::edgeTable[entry] == 0) return;
    for (const int* triangle = octomap::triTable[entry]; *triangle != -1; triangle += 3) {
      const point3d& a = octomap::vertexList[triangle[0]];
      const point3d& b = octomap::vertexList[triangle[1]];
      const point3d& c = octomap::vertexList[triangle[2]];
      normals.push_back((b - a).cross(c - a).normalize());
    }
  }
}

bool intersectCell(double resolution, const point3d& origin, const point3d& direction, const point3d& centre,
                   double delta, point3d& intersection) {
  const auto half = static_cast<float>(resolution / 2.0);
  const point3d low(centre.x() - half, centre.y() - half, centre.z() - half);
  const point3d high(centre.x() + half, centre.y() + half, centre.z() + half);
  bool found = false;
  double nearest = std::numeric_limits<double>::max();
  for (unsigned axis = 0; axis < 3; ++axis) {
    point3d normal;
    normal(axis) = 1.0F;
    const double along = normal.dot(direction);
    if (along == 0.0) continue;  // parallel to both faces
    const unsigned u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const float face : {low(axis), high(axis)}) {
      point3d on_face = centre;
      on_face(axis) = face;
      const double distance = (on_face - origin).dot(normal) / along;
      const point3d meeting = direction * static_cast<float>(distance) + origin;
      if (isOutside(meeting(u), low(u), high(u)) || isOutside(meeting(v), low(v), high(v))) continue;
      nearest = std::min(nearest, distance);
      found = true;
    }
  }
  if (found) intersection = direction * static_cast<float>(nearest + delta) + origin;
  return found;
}

}  // namespace rhmap
