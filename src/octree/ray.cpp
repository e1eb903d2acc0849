// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/ray.hpp"

#include <cmath>
#include <limits>

#include "rhmap/octree/ray_cast.hpp"

namespace rhmap {
namespace {

/// Step direction of a ray along an axis, and its border distances as in Ray, from a coordinate in a cell with this
/// key. HALF is the type that OctoMap keeps half a cell in: float in computeRayKeys, double in castRay.
template <class HALF>
int startAxis(const KeySpace& keys, key_type key, float origin, float direction, double& t_max, double& t_delta) {
  const int step = int{direction > 0.0F} - int{direction < 0.0F};
  if (step == 0) {
    t_max = t_delta = std::numeric_limits<double>::max();
    return 0;
  }
  const double border = keys.keyToCoord(key) + double(static_cast<HALF>(double(step) * keys.resolution() * 0.5));
  t_max = (border - double(origin)) / double(direction);
  t_delta = keys.resolution() / double(std::fabs(direction));
  return step;
}

}  // namespace

RayStart startSegment(const KeySpace& keys, const point3d& origin, const point3d& end, RaySegment& ray) {
  if (!keys.coordToKeyChecked(origin, ray.key) || !keys.coordToKeyChecked(end, ray.end)) return RayStart::kOutside;
  if (ray.key == ray.end) return RayStart::kSameCell;
  point3d direction = end - origin;
  const auto length = static_cast<float>(direction.norm());
  direction /= length;
  ray.length = double(length);
  for (unsigned i = 0; i < 3; ++i)
    ray.step[i] = startAxis<float>(keys, ray.key[i], origin(i), direction(i), ray.t_max[i], ray.t_delta[i]);
  return RayStart::kRay;
}

bool startCast(const KeySpace& keys, const point3d& origin, const OcTreeKey& key, const point3d& direction,
               RayCast& ray) {
  bool moves = false;
  ray.mirror = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const int step = startAxis<double>(keys, key[i], origin(i), direction(i), ray.t_max[i], ray.t_delta[i]);
    moves = moves || step != 0;
    // Without a branch: in which of eight directions a ray goes is anybody's guess.
    ray.mirror |= cell_word::kAxis[i] & -std::uint64_t{step < 0};
  }
  ray.mirrored = cell_word::fromKey(key) ^ ray.mirror;
  ray.entry = 0;
  ray.in_space = true;
  return moves;
}

point3d unitVector(const point3d& v) { return v.normalized(); }

double distance(const point3d& a, const point3d& b) { return (b - a).norm(); }

point3d cutAt(const point3d& origin, const point3d& end, double max_range) {
  const point3d direction = (end - origin).normalized();
  return origin + direction * static_cast<float>(max_range);
}

bool computeRayKeys(const KeySpace& keys, const point3d& origin, const point3d& end, KeyRay& ray) {
  ray.reset();
  return forEachRayKey(keys, origin, end, [&ray](const OcTreeKey& key) {
    if (ray.size() < ray.sizeMax()) ray.addKey(key);
  });
}

}  // namespace rhmap
