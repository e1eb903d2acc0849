// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "rhmap/core/region_cursor.hpp"
#include "rhmap/octree/key_space.hpp"

namespace rhmap {

/// Which of the 27 cells around a cell are occupied: [x][y][z], each 0 (one key below), 1 (the cell itself) or 2.
using OccupiedAround = std::array<std::array<std::array<bool, 3>, 3>, 3>;

/// Unit normals, towards free space, of the surface around the middle cell: marching cubes over groups of eight cells
/// that have it as a corner. Appends to `normals`.
///
/// OctoMap's answer, oddities included. It looks at the groups in a fixed order and stops at the first one that the
/// surface does not cross. And the groups below the cell along x are not what was meant: their eight cells take x
/// offsets 0, -1, -1, 0 whatever the order of their corners asks for.
void appendSurfaceNormals(const OccupiedAround& occupied, std::vector<point3d>& normals);

/// The surface around the cell at a point [m]: see appendSurfaceNormals. `normals` loses what was in it. False if the
/// point is outside of the tree. Cells that are not known count as occupied if `unknown_is_occupied`. At the border of
/// the tree the neighbours are those at the opposite border.
template <class NODE, class IsOccupied>
bool surfaceNormals(const BlockStore<NODE>& store, const KeySpace& keys, const point3d& point, bool unknown_is_occupied,
                    IsOccupied&& is_occupied, std::vector<point3d>& normals) {
  normals.clear();
  OcTreeKey centre;
  if (!keys.coordToKeyChecked(point, centre)) return false;
  RegionCursor<NODE> cursor(store);
  OccupiedAround occupied;
  const auto near = [](key_type k, unsigned i) { return static_cast<key_type>(k + i - 1); };
  for (unsigned x = 0; x < 3; ++x)
    for (unsigned y = 0; y < 3; ++y)
      for (unsigned z = 0; z < 3; ++z) {
        const NODE* node = cursor.search({near(centre[0], x), near(centre[1], y), near(centre[2], z)});
        occupied[x][y][z] = node == nullptr ? unknown_is_occupied : is_occupied(node);
      }
  appendSurfaceNormals(occupied, normals);
  return true;
}

/// Where a line meets the faces of a cell of edge length `resolution` around `centre` [m]: at the face with the
/// smallest distance along `direction` (in lengths of it), negative ones included, and `delta` further on. False, with
/// `intersection` untouched, if it meets none; a line that runs along a face meets only the faces across.
///
/// OctoMap's answer, oddities included: faces reach 1e-6 m too far; where a coordinate is NaN, the line counts as
/// meeting the face.
bool intersectCell(double resolution, const point3d& origin, const point3d& direction, const point3d& centre,
                   double delta, point3d& intersection);

}  // namespace rhmap
