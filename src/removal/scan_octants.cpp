// SPDX-License-Identifier: BSD-3-Clause
#include "scan_octants.hpp"

#include <algorithm>
#include <array>

#include "octant.hpp"

namespace rhmap {
namespace {

constexpr std::size_t kAhead = 16;  // runs whose place in the index is asked for before it is looked at

/// The points that follow each other in the scan and fall in one octant: from `cell` and `range` on, which move on.
/// Written field by field: GCC puts a value to return together in memory, and waits for it there.
void nextRun(const std::uint64_t*& cell, const std::uint64_t* end, const float*& range, float reach, HitOctant& run) {
  const std::uint64_t name = *cell >> 6;
  std::uint64_t cubes = 0, reached = 0;
  int n = 0;
  do {
    const std::uint64_t cube = maskOf(static_cast<int>(*cell & 63));
    const bool is_reached = *range <= reach;
    cubes |= cube;
    reached |= is_reached ? cube : 0;
    n += is_reached;
    ++range;
  } while (++cell != end && *cell >> 6 == name);
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
  const auto add = [&](const HitOctant& run) {
    HitOctant& octant = *index_.findOrInsert(run.name, [&] { return &list_.emplace_back(run.name); });
    octant.cubes |= run.cubes;
    octant.reached |= run.reached;
    octant.points += run.points;
  };
  const std::uint64_t *cell = points.cell.data(), *end = cell + points.size();
  const float* range = points.range.data();
  std::size_t n = 0;
  for (; cell != end; ++n) {
    HitOctant& run = runs[n % kAhead];
    if (n >= kAhead) add(run);
    nextRun(cell, end, range, static_cast<float>(reach), run);
    index_.prefetch(run.name);
  }
  for (std::size_t i = n - std::min(n, kAhead); i < n; ++i) add(runs[i % kAhead]);
}

}  // namespace rhmap
