// SPDX-License-Identifier: BSD-3-Clause
#include "scan_octants.hpp"

#include <array>

#include "octant.hpp"

namespace rhmap {
namespace {

constexpr std::size_t kAhead = 32;  // runs that are looked up together

/// The next run of points that follow each other in the scan and fall in one octant, from point `k` on, which moves on.
HitOctant nextRun(const ScanPoints& points, float reach, std::size_t& k) {
  HitOctant run{.name = points.cell[k] >> 6};
  do {
    const std::uint64_t cube = maskOf(static_cast<int>(points.cell[k] & 63));
    const bool is_reached = points.range[k] <= reach;
    run.cubes |= cube;
    run.reached |= is_reached ? cube : 0;
    run.points += is_reached;
  } while (++k < points.size() && points.cell[k] >> 6 == run.name);
  return run;
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
      runs[n] = nextRun(points, static_cast<float>(reach), k);
      index_.prefetch(runs[n].name);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const HitOctant& run = runs[i];
      HitOctant* octant = index_.find(run.name);
      if (octant == nullptr) {
        index_.insert(run.name, &list_.emplace_back(run));
      } else {
        octant->cubes |= run.cubes;
        octant->reached |= run.reached;
        octant->points += run.points;
      }
    }
  }
}

}  // namespace rhmap
