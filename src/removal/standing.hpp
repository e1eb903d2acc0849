// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "free_space.hpp"
#include "region_map.hpp"
#include "rhmap/removal/removal_config.hpp"
#include "scan_trace.hpp"

namespace rhmap {

/// Notes the cells of the void that a scan has hit. Of those where something stands, all cubes are firm: far away,
/// scans hit a wall or a bush again and again and hardly ever the same cube of it.
void noteStanding(const ScanTrace& trace, const FreeSpace& free_space, const StandingConfig& config);

}  // namespace rhmap
