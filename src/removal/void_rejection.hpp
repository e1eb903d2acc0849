// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

#include "free_space.hpp"
#include "ground.hpp"
#include "scan_to_map.hpp"

namespace rhmap {

/// Takes the hits of things that move out of the scan before they enter the map: what is hit in the void, and what
/// belongs to it. Cubes that the map had before are appended to `removed`. Returns the number of cubes rejected.
std::size_t rejectInVoid(const RegionMap& map, const GroundEstimation& ground, const ScanTrace& trace,
                         const CellGrid& voids, int shift, const std::deque<std::shared_ptr<const ScanContext>>& past, const LookBack& look_back, const VoidConfig& config, double resolution,
                         std::vector<RemovedOctant>& removed);

}  // namespace rhmap
