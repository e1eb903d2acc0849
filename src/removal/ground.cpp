// SPDX-License-Identifier: BSD-3-Clause
#include "ground.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace rhmap {
namespace {

/// The cubes of a region, each coordinate and each product of two in a list of its own, so that choosing some of them
/// and summing these up is vector code.
class CubeLists {
 public:
  explicit CubeLists(std::span<const LocalCube> cubes) : n_((cubes.size() + 7) / 8 * 8) {
    std::fill_n(lists_[0].begin(), cubes.size(), std::int16_t{1});
    for (std::size_t i = 0; i < cubes.size(); ++i) {
      lists_[1][i] = static_cast<std::int16_t>(cubes[i].x);
      lists_[2][i] = static_cast<std::int16_t>(cubes[i].y);
      lists_[3][i] = static_cast<std::int16_t>(cubes[i].z);
    }
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t i = cubes.size(); i < n_; ++i) lists_[k][i] = 0;
    std::size_t product = 4;
    for (std::size_t a = 1; a < 4; ++a) {
      for (std::size_t b = a; b < 4; ++b, ++product)
        for (std::size_t i = 0; i < n_; ++i)
          lists_[product][i] = static_cast<std::int16_t>(lists_[a][i] * lists_[b][i]);
    }
  }

  /// Chooses the cubes for which counts(x, y, z) holds.
  template <class Counts>
  void choose(Counts&& counts) {
    for (std::size_t i = 0; i < n_; ++i)
      chosen_[i] =
          counts(static_cast<float>(lists_[1][i]), static_cast<float>(lists_[2][i]), static_cast<float>(lists_[3][i]))
              ? std::int16_t{1}
              : std::int16_t{0};
  }

  /// Of the chosen ones: how many; the sums of x, y, z; of xx, xy, xz, yy, yz, zz.
  static constexpr std::size_t kLists = 10;
  std::array<int, kLists> sums() const {
    std::array<int, kLists> sums{};
    for (std::size_t k = 0; k < kLists; ++k) {
      int sum = 0;
      for (std::size_t i = 0; i < n_; ++i) sum += chosen_[i] * lists_[k][i];
      sums[k] = sum;
    }
    return sums;
  }

 private:
  // Of the largest region, and a line of the cache, so that lists do not lie at the same place of all pages.
  static constexpr std::size_t kMost = 16 * 16 * 16 + 32;
  std::size_t n_;
  std::array<std::int16_t, kMost> chosen_;
  std::array<std::array<std::int16_t, kMost>, kLists> lists_;
};

/// Of the chosen cubes: through their mean, normal to the direction of least spread; nothing if there are too few or it
/// is steeper than allowed.
std::optional<Plane> principalPlane(const CubeLists& cubes, const GroundConfig& config) {
  const auto [n, x, y, z, xx, xy, xz, yy, yz, zz] = cubes.sums();
  if (n < config.min_cubes) return std::nullopt;
  const Eigen::Vector3d mean = Eigen::Vector3d(x, y, z) / n;
  Eigen::Matrix3d covariance;
  covariance << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  covariance = covariance / n - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  Eigen::Vector3d normal = solver.eigenvectors().col(0);
  if (normal.z() < 0) normal = -normal;
  if (!(normal.z() >= config.min_upright)) return std::nullopt;
  return Plane{.n = {static_cast<float>(normal.x()), static_cast<float>(normal.y()), static_cast<float>(normal.z())},
               .d = static_cast<float>(normal.dot(mean))};
}

/// In cubes, of a plane in its region: in the middle, from the region's lowest cube.
float heightOf(const Plane& plane, float size) { return (plane.d - (plane.n[0] + plane.n[1]) * size / 2) / plane.n[2]; }

}  // namespace

std::optional<Plane> fitGround(std::span<const LocalCube> cubes, const GroundConfig& config, double resolution) {
  CubeLists lists(cubes);
  int sum = 0;
  for (const LocalCube& c : cubes) sum += c.z;
  const double mean = sum / std::max<double>(1, static_cast<double>(cubes.size()));
  // Not above the mean, where the paper has "smaller than": a flat region of one layer has no smaller ones.
  lists.choose([highest = static_cast<float>(std::floor(mean))](float, float, float z) { return z <= highest; });
  auto plane = principalPlane(lists, config);
  const auto r_gro = static_cast<float>(config.r_gro / resolution);
  for (int i = 1; plane && i < config.iterations; ++i) {
    lists.choose([&, last = *plane](float x, float y, float z) { return std::fabs(last.above(x, y, z)) < r_gro; });
    plane = principalPlane(lists, config);
  }
  return plane;
}

GroundEstimation::GroundEstimation(const GroundConfig& config, double resolution)
    : config_(config),
      resolution_(resolution),
      band_{
          .r_gro = static_cast<float>(config.r_gro / resolution),
          .depth = config.depth > 0 ? static_cast<float>(config.depth / resolution) : std::numeric_limits<float>::max(),
          .thin = static_cast<float>((config.thin < 0 ? config.r_gro : config.thin) / resolution)} {}

void GroundEstimation::update(const RegionMap& map, const ScanTrace& trace) const {
  if (!config_.enabled) return;
  const auto columnAt = [&](std::size_t i) { return trace.columns[i].column; };
  const auto askFor = [&](const Column& column) __attribute__((always_inline)) {
    const bool to_fit = column.base != nullptr && hasGrown(column);
    for (const Region* region : column.regions) {
      if (region->z > column.base_z + 1) break;
      prefetchOctants(*region, to_fit ? region->known_octants : region->scan == trace.scan ? region->fresh_octants : 0);
    }
    for (std::size_t i = 0; i < kBeside; ++i) __builtin_prefetch(column.around[i]);
  };
  visitColumns(trace.columns.size(), columnAt, askFor, [&](Column& column) {
    Region* lowest = column.lowest();
    if (lowest == nullptr) return;
    bool anew = lowest != column.base;
    if (anew) setBase(column, lowest);
    if (lowest->scan == trace.scan && isCandidate(column)) {
      fit(map, column);
      anew = true;
    }
    for (Region* region : column.regions) {
      if (region->z > lowest->z + 1) break;
      if (anew || (region->scan == trace.scan && region->fresh_octants != 0)) mark(map, column, *region, !anew);
    }
  });
}

/// What was taken for ground before, while the ground was out of sight, was the top of something.
void GroundEstimation::setBase(Column& column, Region* lowest) const {
  for (Region* region : column.regions) {
    region->loose_octants = 0;
    forEachBit(region->known_octants, [&](int o) {
      Octant& octant = region->octant(static_cast<std::size_t>(o));
      octant.ground = octant.safe = 0;
      region->loose_octants |= std::uint64_t{octant.occupied != 0} << o;
    });
  }
  column.base = lowest;
  column.base_z = lowest->z;
  column.has_ground = false;
  column.at_fit = 0;
}

/// The base of a column has cubes that no fit has seen yet, so many that each region is fitted a few times only.
bool GroundEstimation::hasGrown(const Column& column) const {
  const int cubes = column.base->cubes;
  return cubes >= config_.min_cubes && !(cubes < column.at_fit * (1 + config_.min_growth));
}

/// Eq. (4): the lowest region of its column, if it has grown; and with occupied neighbours, as noise has none.
bool GroundEstimation::isCandidate(const Column& column) const {
  if (!hasGrown(column)) return false;
  const Region& region = *column.base;
  for (const Column* beside : column.around) {
    if (beside == nullptr) continue;
    for (const Region* other : beside->regions)
      if (std::abs(int{other->z} - int{region.z}) <= 1 && other->cubes > 0) return true;
  }
  return false;
}

/// Ground has no steps up from all that is beside it: the roof of a car has, where the road is out of sight.
bool GroundEstimation::standsOut(const RegionMap& map, const Column& column, const Plane& plane) const {
  if (config_.max_step <= 0) return false;
  const auto size = static_cast<float>(map.size()), half = size / 2;
  const float z = heightOf(plane, size);
  for (std::size_t i = 0; i < kAround.size(); ++i) {
    const Column* other = column.around[i];
    if (other == nullptr || !other->has_ground) continue;
    const auto dx = static_cast<float>(kAround[i].x), dy = static_cast<float>(kAround[i].y);
    const float above = other->ground.above(half - dx * size, half - dy * size,
                                            z + static_cast<float>(int{column.base_z} - int{other->base_z}) * size);
    if (static_cast<double>(above) * resolution_ > config_.max_step) return true;
  }
  return false;
}

/// Nor is it far above a third of what is ground around: what is seen over a row of cars is roofs and heads, in many
/// columns beside each other. On a slope, as much is above it as below.
bool GroundEstimation::isRaised(const RegionMap& map, const Column& column, const Plane& plane) const {
  if (config_.around <= 0) return false;
  constexpr int kEach = 2, kPlaces = (2 * kEach + 1) * (2 * kEach + 1) - 1;  // to all sides
  constexpr int kEnough = 2;                                                 // planes below
  const auto size = static_cast<float>(map.size());
  const double width = map.size() * resolution_;                                                   // [m]
  const auto apart = static_cast<int>(std::max(1L, std::lround(config_.around / kEach / width)));  // columns
  const float z = heightOf(plane, size) + static_cast<float>(column.base_z) * size;
  for (int i = -kEach; i <= kEach; ++i)
    for (int j = -kEach; j <= kEach; ++j) map.prefetch(column.x + i * apart, column.y + j * apart);
  int below = 0, level = 0, above = 0;
  for (int i = -kEach; i <= kEach; ++i) {
    for (int j = -kEach; j <= kEach; ++j) {
      const Column* other = i == 0 && j == 0 ? nullptr : map.find(column.x + i * apart, column.y + j * apart);
      if (other == nullptr || !other->has_ground) continue;
      const double step =
          double{z - heightOf(other->ground, size) - static_cast<float>(other->base_z) * size} * resolution_;
      const double least = config_.raised + config_.rise * width * apart * std::hypot(i, j);
      ++(step > least ? below : step < -least ? above : level);
      if (3 * level > 2 * kPlaces) return false;  // most often so
    }
  }
  return below >= kEnough && 3 * (below - above) >= below + level + above;
}

void GroundEstimation::fit(const RegionMap& map, Column& column) const {
  std::array<LocalCube, 16 * 16 * 16> cubes;  // of the largest region
  std::size_t n = 0;
  forEachBit(column.base->known_octants, [&](int number) {
    const auto o = static_cast<std::size_t>(number);
    const auto [x, y, z] = cornerInRegion(o);
    forEachBit(column.base->octant(o).occupied, [&, x = x, y = y, z = z](int bit) {
      const auto& place = kPlaceInOctant[static_cast<std::size_t>(bit)];
      cubes[n++] = {x + place[0], y + place[1], z + place[2]};
    });
  });
  column.at_fit = static_cast<std::uint16_t>(n);
  const std::optional<Plane> plane = fitGround({cubes.data(), n}, config_, resolution_);
  const bool had_ground = column.has_ground;  // and so not raised: it takes longer to look around than to fit a plane
  column.has_ground = plane && !standsOut(map, column, *plane) && (had_ground || !isRaised(map, column, *plane));
  if (plane) column.ground = *plane;
}

/// Eq. (5), for all cubes of the region and not only for those that the plane was fitted to: ground is thicker than a
/// layer. What lies just below the plane is ground, too; farther below, the plane is that of something on the ground.
void GroundEstimation::mark(const RegionMap& map, const Column& column, Region& region, bool only_fresh) const {
  std::array<NearPlane, 6> near;  // those that may hold ground of this region
  std::size_t n = 0;
  const auto size = static_cast<float>(map.size());
  const auto consider = [&](const Column* other) {
    if (other == nullptr || !other->has_ground || std::abs(int{other->base_z} - int{region.z}) > 1) return;
    near[n++] = {&other->ground, size * static_cast<float>(int{region.x} - int{other->x}),
                 size * static_cast<float>(int{region.y} - int{other->y}),
                 size * static_cast<float>(int{region.z} - int{other->base_z})};
  };
  const bool is_base = &region == column.base;
  if (is_base || config_.across_regions) consider(&column);
  if (config_.across_regions && !(is_base && column.has_ground)) {
    for (std::size_t i = 0; i < kBeside; ++i) consider(column.around[i]);
  }
  if (only_fresh && n == 0) return;
  forEachBit(only_fresh ? region.fresh_octants : region.known_octants, [&](int number) {
    const auto o = static_cast<std::size_t>(number);
    Octant& octant = region.octant(o);
    const std::uint64_t which = only_fresh ? octant.fresh & octant.occupied : octant.occupied;
    const GroundCubes cubes = nearGround({near.data(), n}, cornerInRegion(o), band_);
    octant.ground = (octant.ground & ~which) | (cubes.ground & which);
    octant.safe = (octant.safe & ~which) | (cubes.safe & which);
    const bool is_loose = (octant.occupied & ~octant.safe) != 0;
    region.loose_octants = (region.loose_octants & ~maskOf(number)) | std::uint64_t{is_loose} << o;
  });
}

}  // namespace rhmap
