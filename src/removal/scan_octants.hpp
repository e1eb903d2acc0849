// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "rhmap/core/block_index.hpp"
#include "rhmap/core/cell_word.hpp"
#include "scan_points.hpp"

namespace rhmap {

/// The cubes of a scan in one octant.
struct HitOctant {
  std::uint64_t name = 0;     ///< cell_word of its cubes >> 6
  std::uint64_t cubes = 0;    ///< that were hit
  std::uint64_t reached = 0;  ///< of these, with points that contexts reach
  int points = 0;             ///< that contexts reach

  /// Its lowest cube.
  OcTreeKey corner() const { return cell_word::toKey(name << 6); }
};

/// The octants of a scan. Gathered before the map is looked at, in little memory, so that the map, which is larger than
/// the caches, is looked at once for each.
class ScanOctants {
 public:
  ScanOctants() = default;
  ScanOctants(const ScanPoints& points, double reach) { gather(points, reach); }

  /// Instead of those before. `reach`: of the contexts [m].
  void gather(const ScanPoints& points, double reach);

  /// In the order of their first points.
  const std::vector<HitOctant>& list() const { return list_; }

 private:
  std::vector<HitOctant> list_;
  BlockIndex<HitOctant> index_;
};

}  // namespace rhmap
