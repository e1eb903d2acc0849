// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "arguments.hpp"
#include "rhmap/core/key_set.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "rhmap/removal/rh_map.hpp"

namespace rhmap::tools {

/// Adds the cells of a scan that `map` takes for ground now.
void addGround(const io::Scan& scan, const RhMap& map, KeySet& ground);

/// The cells of this edge [m] that the removal's ground estimate takes for ground when the sequence's scans hit them,
/// with a bar of progress.
KeySet groundCells(const io::ScanSequence& sequence, const FrameRange& frames, double resolution);

}  // namespace rhmap::tools
