// SPDX-License-Identifier: BSD-3-Clause
#include "scan_octants.hpp"

#include <array>

#include "octant.hpp"

namespace rhmap {
namespace {

constexpr std::size_t kAhead = 32;  // runs that are looked up together

/// The next run of points that follow each other in the scan and fall in one octant, from point `k` on, which moves on.
/// Written field by field: GCC puts a value to return together in memory, and waits for it there.
void nextRun(const ScanPoints& points, float reach, std::size_t& k, HitOctant& run) {
  const std::uint64_t name = points.cell[k] >> 6;
  std::uint64_t cubes = 0, reached = 0;
  int n = 0;
  do {
    const std::uint64_t cube = maskOf(static_cast<int>(points.cell[k] & 63));
    const bool is_reached = points.range[k] <= reach;
    cubes |= cube;
    reached |= is_reached ? cube : 0;
    n += is_reached;
  } while (++k < points.size() && points.cell[k] >> 6 == name);
  run.name = name;
  run.cubes = cubes;
  run.reached = reached;
  run.points = n;
}

}  // namespace

void ScanOctants::gather(const ScanPoints& points, double reach) {
  list_.clear();
  list_.reserve(points.size());  // whose addresses the index holds
  index_.reset();
  std::array<HitOctant, kAhead> runs;
  for (std::size_t k = 0; k < points.size();) {
    std::size_t n = 0;
    for (; n < kAhead && k < points.size(); ++n) {
      nextRun(points, static_cast<float>(reach), k, runs[n]);
      index_.prefetch(runs[n].name);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const HitOctant& run = runs[i];
      HitOctant& octant = *index_.findOrInsert(run.name, [&] { return &list_.emplace_back(run.name); });
      octant.cubes |= run.cubes;
      octant.reached |= run.reached;
      octant.points += run.points;
    }
  }
}

}  // namespace rhmap
