// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/ray.hpp"

#include <cmath>
#include <limits>

namespace rhmap {
namespace {

/// Step directions and border distances from a point in cell `ray.key`. `half_step` turns half a cell into the type
/// that OctoMap keeps it in: float in computeRayKeys, double in castRay.
template <class HALF>
void startAxes(const KeySpace& keys, const point3d& origin, const point3d& direction, Ray& ray) {
  for (unsigned i = 0; i < 3; ++i) {
    const float d = direction(i);
    ray.step[i] = int{d > 0.0F} - int{d < 0.0F};
    if (ray.step[i] == 0) {
      ray.t_max[i] = ray.t_delta[i] = std::numeric_limits<double>::max();
      continue;
    }
    const double border =
        keys.keyToCoord(ray.key[i]) + double(static_cast<HALF>(double(ray.step[i]) * keys.resolution() * 0.5));
    ray.t_max[i] = (border - double(origin(i))) / double(d);
    ray.t_delta[i] = keys.resolution() / double(std::fabs(d));
  }
}

}  // namespace

RayStart startSegment(const KeySpace& keys, const point3d& origin, const point3d& end, RaySegment& ray) {
  if (!keys.coordToKeyChecked(origin, ray.key) || !keys.coordToKeyChecked(end, ray.end)) return RayStart::kOutside;
  if (ray.key == ray.end) return RayStart::kSameCell;
  point3d direction = end - origin;
  const auto length = static_cast<float>(direction.norm());
  direction /= length;
  ray.length = double(length);
  startAxes<float>(keys, origin, direction, ray);
  return RayStart::kRay;
}

std::optional<Ray> startCast(const KeySpace& keys, const point3d& origin, const OcTreeKey& key,
                             const point3d& direction) {
  Ray ray;
  ray.key = key;
  startAxes<double>(keys, origin, direction, ray);
  if (ray.step[0] == 0 && ray.step[1] == 0 && ray.step[2] == 0) return std::nullopt;
  return ray;
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
