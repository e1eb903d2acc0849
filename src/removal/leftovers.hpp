// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "region_map.hpp"
#include "rhmap/removal/removal_config.hpp"
#include "scan_to_map.hpp"

namespace rhmap {

/// Takes the leftovers of what moves out of the regions: cubes that few scans have hit, where most of what was around
/// has gone. No scan may ever tell of them: they were hit once, and are hidden since. Looks in and around some octants
/// (their lowest cubes) that have just lost cubes, and wherever cubes have gone in every so many columns (0: in none),
/// whose turn goes over all from scan to scan. `result` gets what goes.
void removeLeftovers(const RegionMap& map, std::span<const OcTreeKey> changed, int interval,
                     const LeftoverConfig& config, double resolution, const LookConfig& look, RemovalResult& result);

}  // namespace rhmap
