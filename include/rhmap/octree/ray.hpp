// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <algorithm>

#include "rhmap/octree/key_space.hpp"

namespace rhmap {

/// A ray through the grid (Amanatides & Woo), with OctoMap's arithmetic to the last bit: the same mix of float and
/// double, the same order of ties, the same stop.
struct Ray {
  double t_max[3];    ///< distance along the ray [m] at which it leaves the current cell along each axis
  double t_delta[3];  ///< distance between two cell borders along each axis [m]
  int step[3];        ///< -1, 0 or 1
  OcTreeKey key;      ///< current cell

  /// The axis along which the ray leaves the current cell: z before x and y, y before x where they tie.
  int nextAxis() const { return t_max[0] < t_max[1] ? (t_max[0] < t_max[2] ? 0 : 2) : (t_max[1] < t_max[2] ? 1 : 2); }

  /// To the next cell along an axis. A branch for each axis, so that the ray stays in registers: an index known only at
  /// run time would send it through memory at every step.
  void advance(int axis) {
    if (axis == 0) {
      advanceAlong<0>();
    } else if (axis == 1) {
      advanceAlong<1>();
    } else {
      advanceAlong<2>();
    }
  }

  /// Distance [m] at which the ray leaves the current cell.
  double exitDistance() const { return std::min(std::min(t_max[0], t_max[1]), t_max[2]); }

 private:
  template <unsigned AXIS>
  void advanceAlong() {
    key[AXIS] = static_cast<key_type>(key[AXIS] + step[AXIS]);
    t_max[AXIS] += t_delta[AXIS];
  }
};

/// A ray that ends: OctoMap's computeRayKeys.
struct RaySegment : Ray {
  OcTreeKey end;  ///< the cell that is not entered any more
  double length;  ///< [m], rounded to float; the ray stops here at the latest should it miss `end` by rounding
};

/// What becomes of a ray between two points.
enum class RayStart { kOutside, kSameCell, kRay };

/// Sets up OctoMap's computeRayKeys. `ray` is valid only for kRay.
RayStart startSegment(const KeySpace& keys, const point3d& origin, const point3d& end, RaySegment& ray);

/// direction / |direction| and |b - a|, as OctoMap computes them (out of line, so that a consumer's -mfma cannot fuse
/// them).
point3d unitVector(const point3d& v);
double distance(const point3d& a, const point3d& b);

/// Where OctoMap cuts a ray that is longer than `max_range` [m].
point3d cutAt(const point3d& origin, const point3d& end, double max_range);

/// Visits the cells from the origin's (included) to the end's (excluded); none if they are the same. False if one of
/// the points is outside of the tree.
template <class Visit>
bool forEachRayKey(const KeySpace& keys, const point3d& origin, const point3d& end, Visit&& visit) {
  RaySegment ray;
  const RayStart start = startSegment(keys, origin, end, ray);
  if (start != RayStart::kRay) return start == RayStart::kSameCell;
  do {
    visit(static_cast<const OcTreeKey&>(ray.key));
    ray.advance(ray.nextAxis());
  } while (ray.key != ray.end && !(ray.exitDistance() > ray.length));
  return true;
}

/// OctoMap's computeRayKeys. A ray holds 100000 keys at the most; a longer one ends there.
bool computeRayKeys(const KeySpace& keys, const point3d& origin, const point3d& end, KeyRay& ray);

}  // namespace rhmap
