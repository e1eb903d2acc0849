// SPDX-License-Identifier: BSD-3-Clause
#include "ground.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

namespace rhmap {
namespace {

LocalCube localOf(const RegionMap& map, int octant, int bit) {
  const auto o = static_cast<unsigned>(octant), b = static_cast<unsigned>(bit);
  (void)map;
  return {static_cast<std::int16_t>((gather3(o) << 2) + gather3(b)),
          static_cast<std::int16_t>((gather3(o >> 1) << 2) + gather3(b >> 1)),
          static_cast<std::int16_t>((gather3(o >> 2) << 2) + gather3(b >> 2))};
}

bool isOccupied(const RegionMap& map, const Region& region) {
  for (int o = 0; o < map.octants(); ++o)
    if (region.octants[static_cast<std::size_t>(o)].occupied != 0) return true;
  return false;
}

/// Through the mean of the cubes, normal to the direction of least spread; null if it is steeper than allowed.
std::optional<Plane> principalPlane(std::span<const LocalCube> cubes, double min_upright) {
  int n = 0, sx = 0, sy = 0, sz = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (const LocalCube& c : cubes) {
    ++n, sx += c.x, sy += c.y, sz += c.z;
    xx += c.x * c.x, xy += c.x * c.y, xz += c.x * c.z, yy += c.y * c.y, yz += c.y * c.z, zz += c.z * c.z;
  }
  const Eigen::Vector3d mean = Eigen::Vector3d(sx, sy, sz) / n;
  Eigen::Matrix3d covariance;
  covariance << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  covariance = covariance / n - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  Eigen::Vector3d normal = solver.eigenvectors().col(0);
  if (normal.z() < 0) normal = -normal;
  if (!(normal.z() >= min_upright)) return std::nullopt;
  const Eigen::Vector3f f = normal.cast<float>();
  return Plane{.n = {f.x(), f.y(), f.z()}, .d = static_cast<float>(normal.dot(mean))};
}

}  // namespace

std::optional<Plane> fitGround(std::span<const LocalCube> cubes, const GroundConfig& config, double resolution) {
  const auto enough = [&](const std::vector<LocalCube>& some) {
    return some.size() >= static_cast<std::size_t>(config.min_cubes);
  };
  int sum = 0;
  for (const LocalCube& c : cubes) sum += c.z;
  const double mean = cubes.empty() ? 0 : double(sum) / double(cubes.size());
  std::vector<LocalCube> seeds;
  for (const LocalCube& c : cubes)
    if (c.z <= mean) seeds.push_back(c);
  const auto r_gro = static_cast<float>(config.r_gro / resolution);
  std::optional<Plane> plane;
  for (int i = 0; i < config.iterations; ++i) {
    if (!enough(seeds)) return std::nullopt;
    plane = principalPlane(seeds, config.min_upright);
    if (!plane) return std::nullopt;
    if (i + 1 == config.iterations) break;
    std::size_t before = seeds.size();
    seeds.clear();
    for (const LocalCube& c : cubes)
      if (std::fabs(plane->above(c.x, c.y, c.z)) < r_gro) seeds.push_back(c);
    (void)before;
  }
  return plane;
}

Region* lowestRegion(const RegionMap& map, const Column& column) {
  for (const auto& region : column.regions)
    if (isOccupied(map, *region)) return region.get();
  return nullptr;
}

GroundEstimation::GroundEstimation(const GroundConfig& config, double resolution)
    : config_(config), resolution_(resolution), r_gro_(static_cast<float>(config.r_gro / resolution)) {}

bool GroundEstimation::isCandidate(const RegionMap& map, const Region& region) const {
  const int cubes = map.countCubes(region);
  return cubes >= config_.min_cubes && cubes >= region.at_fit * (1 + config_.min_growth);
}

bool GroundEstimation::hasNeighbour(const RegionMap& map, const Region& region) const {
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      if (dx == 0 && dy == 0) continue;
      const Column* column = map.find(static_cast<key_type>(region.x + dx), static_cast<key_type>(region.y + dy));
      if (column == nullptr) continue;
      for (const auto& other : column->regions)
        if (std::abs(int{other->z} - int{region.z}) <= 1 && isOccupied(map, *other)) return true;
    }
  }
  return false;
}

bool GroundEstimation::standsOut(const RegionMap& map, const Region& region, const Plane& plane) const {
  if (config_.step <= 0) return false;
  const auto size = static_cast<float>(map.size()), half = size / 2;
  const float z = (plane.d - plane.n[0] * half - plane.n[1] * half) / plane.n[2];
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      if (dx == 0 && dy == 0) continue;
      const Column* beside = map.find(static_cast<key_type>(region.x + dx), static_cast<key_type>(region.y + dy));
      const Region* base = beside == nullptr ? nullptr : lowestRegion(map, *beside);
      if (base == nullptr || !base->fitted) continue;
      const float above = base->plane.above(half - static_cast<float>(dx) * size, half - static_cast<float>(dy) * size, z + size * static_cast<float>(int{region.z} - int{base->z}));
      if (above * resolution_ > config_.step) return true;
    }
  }
  return false;
}

void GroundEstimation::fit(const RegionMap& map, Region& region) const {
  std::vector<LocalCube> cubes;
  for (int o = 0; o < map.octants(); ++o)
    forEachBit(region.octants[static_cast<std::size_t>(o)].occupied, [&](int bit) { cubes.push_back(localOf(map, o, bit)); });
  region.at_fit = static_cast<std::uint16_t>(cubes.size());
  const std::optional<Plane> plane = fitGround(cubes, config_, resolution_);
  region.fitted = plane.has_value() && !standsOut(map, region, *plane);
  if (plane) region.plane = *plane;
}

void GroundEstimation::mark(const RegionMap& map, const Column& column, Region& region, bool only_fresh) const {
  // Planes that may hold ground of this region, and where this region's lowest cube is in theirs.
  struct Near {
    const Plane* plane;
    float dx, dy, dz;
  };
  std::array<Near, 8> near;
  std::size_t n = 0;
  const auto size = static_cast<float>(map.size());
  const auto consider = [&](const Region* other) {
    if (other == nullptr || !other->fitted || n == near.size()) return;
    near[n++] = {&other->plane, size * static_cast<float>(int{region.x} - int{other->x}),
                 size * static_cast<float>(int{region.y} - int{other->y}),
                 size * static_cast<float>(int{region.z} - int{other->z})};
  };
  const Region* lowest = lowestRegion(map, column);
  if (&region == lowest) consider(&region);
  if (config_.across_regions) {
    if (lowest != nullptr && region.z == lowest->z + 1) consider(lowest);
    for (const auto& [dx, dy] : {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)}) {
      if (&region == lowest && region.fitted) break;
      const Column* beside = map.find(static_cast<key_type>(region.x + dx), static_cast<key_type>(region.y + dy));
      if (beside == nullptr) continue;
      Region* base = lowestRegion(map, *beside);
      if (base != nullptr && std::abs(int{base->z} - int{region.z}) <= 1) consider(base);
    }
  }
  for (int o = 0; o < map.octants(); ++o) {
    Octant& octant = region.octants[static_cast<std::size_t>(o)];
    const std::uint64_t which = only_fresh ? octant.fresh & octant.occupied : octant.occupied;
    std::uint64_t ground = octant.ground & ~which;
    forEachBit(which, [&](int bit) {
      const LocalCube c = localOf(map, o, bit);
      for (std::size_t i = 0; i < n; ++i) {
        if (near[i].plane->above(c.x + near[i].dx, c.y + near[i].dy, c.z + near[i].dz) < r_gro_) {
          ground |= std::uint64_t{1} << bit;
          break;
        }
      }
    });
    octant.ground = ground;
  }
}

void GroundEstimation::update(const RegionMap& map, const ScanTrace& trace) const {
  if (!config_.enabled) return;
  std::vector<std::pair<Column*, Region*>> marked;
  for (const ScanColumn& scanned : trace.columns) {
    Column& column = *scanned.column;
    Region* lowest = lowestRegion(map, column);
    if (lowest == nullptr) continue;
    bool refitted = false;
    if (lowest != column.base) {
      for (const auto& region : column.regions) {
        region->fitted = false;
        region->at_fit = 0;
        for (int o = 0; o < map.octants(); ++o) region->octants[static_cast<std::size_t>(o)].ground = 0;
      }
      column.base = lowest;
      refitted = true;
    }
    if (lowest->scan == trace.scan && isCandidate(map, *lowest) && hasNeighbour(map, *lowest)) {
      fit(map, *lowest);
      refitted = true;
    }
    for (const auto& region : column.regions) {
      if (region->z > lowest->z + 1) break;
      if (refitted || region->scan == trace.scan) mark(map, column, *region, !refitted);
    }
  }
}

std::optional<float> GroundEstimation::heightAbove(const RegionMap& map, const Column& column,
                                                   const OcTreeKey& cube) const {
  const Region* base = lowestRegion(map, column);
  if (base == nullptr || !base->fitted) return std::nullopt;
  const int bits = map.bits();
  return base->plane.above(static_cast<float>(int{cube[0]} - (base->x << bits)),
                           static_cast<float>(int{cube[1]} - (base->y << bits)),
                           static_cast<float>(int{cube[2]} - (base->z << bits)));
}

}  // namespace rhmap
