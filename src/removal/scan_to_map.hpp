// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "region_map.hpp"
#include "rhmap/removal/removal_config.hpp"
#include "scan_context.hpp"

namespace rhmap {

/// Cubes of an octant that left the map.
struct RemovedCubesOf {
  OcTreeKey corner;
  std::uint64_t cubes;
  bool seen_through;
};

struct RemovalResult {
  std::vector<RemovedCubesOf> removed;
  std::size_t is_protected = 0;  ///< cubes of candidates that stay
};

/// Whose look it is.
struct LookConfig {
  std::uint32_t scan = 0;   ///< the last scan that was traced
  bool protect = true;      ///< cubes that it has hit are not touched
  int revert_hits = 0;      ///< nor are cubes that so many scans have hit; 0: any number
  bool everywhere = false;  ///< cubes beside those of candidates by ratio are looked at, too
};

/// S2M-R (Sec. III-C.2): takes from the regions what the scan shows to have gone.
void removeByScan(const RegionMap& map, const ScanContext& scan, const RemovalConfig& config, double resolution,
                  const LookConfig& look, RemovalResult& result);

}  // namespace rhmap
