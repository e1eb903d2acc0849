// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "region_map.hpp"
#include "rhmap/octree/key_space.hpp"
#include "scan_points.hpp"
#include "scan_trace.hpp"

namespace rhmap::test {

inline constexpr double kCube = 0.1;  // [m]

/// A map without a tree behind it.
inline RegionMap emptyMap(int size = 8) {
  return RegionMap(size, [](key_type, key_type, int) { return std::vector<CubesAt>(); });
}

/// Puts a cube into the map.
inline Octant& occupy(RegionMap& map, const OcTreeKey& cube) {
  Column& column =
      map.getOrCreate(static_cast<key_type>(cube[0] >> map.bits()), static_cast<key_type>(cube[1] >> map.bits()));
  Region& region = map.getOrCreate(column, static_cast<key_type>(cube[2] >> map.bits()));
  Octant& octant = map.getOrCreate(region, map.octantOf(cube));
  if ((octant.occupied & maskOf(bitOf(cube))) == 0) region.add(map.octantOf(cube), maskOf(bitOf(cube)));
  column.stale = true;
  return octant;
}

inline bool isOccupied(const RegionMap& map, const OcTreeKey& cube) {
  const Region* region = map.regionOf(cube);
  return region != nullptr && (region->octant(map.octantOf(cube)).occupied & maskOf(bitOf(cube))) != 0;
}

/// A cube, counted from the middle of the key space.
inline OcTreeKey cubeAt(int x, int y, int z) {
  const auto key = [](int k) { return static_cast<key_type>(kTreeMaxVal + k); };
  return {key(x), key(y), key(z)};
}

/// The lowest cube of a cube's octant.
inline OcTreeKey cornerOf(const OcTreeKey& cube) {
  const auto low = [](key_type k) { return static_cast<key_type>(k & ~3); };
  return {low(cube[0]), low(cube[1]), low(cube[2])};
}

/// Whether a cube is in an octant (its lowest cube) or up to `reach` cubes away.
inline bool isWithin(const OcTreeKey& cube, const OcTreeKey& corner, int reach) {
  for (unsigned axis = 0; axis < 3; ++axis)
    if (cube[axis] + reach < corner[axis] || cube[axis] > corner[axis] + 3 + reach) return false;
  return true;
}

/// Cubes about the middle of the key space.
class RandomCubes {
 public:
  explicit RandomCubes(unsigned seed, int reach = 20) : random_(seed), near_(-reach, reach) {}
  OcTreeKey operator()() { return {at(), at(), at()}; }

 private:
  key_type at() { return static_cast<key_type>(kTreeMaxVal + near_(random_)); }
  std::mt19937 random_;
  std::uniform_int_distribution<int> near_;
};

/// A scan that hits these cubes, each a metre away as far as contexts are concerned.
inline ScanPoints pointsIn(const std::vector<OcTreeKey>& cubes) {
  ScanPoints points;
  for (const OcTreeKey& cube : cubes) points.cell.push_back(cell_word::fromKey(cube));
  for (auto* v : {&points.x, &points.y, &points.z, &points.range}) v->assign(cubes.size(), 1.0F);
  return points;
}

/// Marks the cubes of a scan in a map.
inline ScanTrace trace(RegionMap& map, const ScanPoints& points, const OcTreeKey& sensor, std::uint32_t scan,
                       const TraceConfig& config) {
  ScanTrace trace;
  traceScan(map, ScanOctants(points, config.reach), sensor, scan, config, trace);
  return trace;
}

/// A scan from points in the sensor's frame; the sensor stands at the origin.
inline ScanPoints scanOf(const octomap::Pointcloud& cloud, double min_range = 0) {
  ScanPoints points;
  locatePoints(KeySpace(kCube), cloud, octomap::pose6d(), min_range, -1, points);
  return points;
}

/// What a LiDAR of even beams from +10 to -20 degrees at the origin sees of the plane x = `wall` and of the ground
/// 1.7 m below; no returns farther than 100 m.
inline octomap::Pointcloud wallAndGround(double wall, int rows = 64, int columns = 720) {
  octomap::Pointcloud cloud;
  for (int i = 0; i < rows; ++i) {
    const double elevation = (10.0 - 30.0 * i / (rows - 1)) * 3.14159265358979 / 180;
    for (int j = 0; j < columns; ++j) {
      const double azimuth = (j + 0.5) * 2 * 3.14159265358979 / columns;
      const double x = std::cos(elevation) * std::cos(azimuth), y = std::cos(elevation) * std::sin(azimuth),
                   z = std::sin(elevation);
      double range = 100;
      if (x > 1e-6) range = std::min(range, wall / x);
      if (z < -1e-6) range = std::min(range, -1.7 / z);
      if (range < 100)
        cloud.push_back(static_cast<float>(range * x), static_cast<float>(range * y), static_cast<float>(range * z));
    }
  }
  return cloud;
}

}  // namespace rhmap::test
