// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rhmap/octree/ray_batch.hpp"
#include "rhmap/octree/scan_masks.hpp"

namespace rhmap {

/// Marks the cells that the rays cross: what forEachRayKey visits, for every ray of the batch. Uses the widest vectors
/// that the machine has; the result is the same bits with any.
void walkRays(const RayBatch& rays, ScanMasks& masks);

}  // namespace rhmap
