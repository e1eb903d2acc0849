// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "rhmap/core/key_set.hpp"
#include "rhmap/eval/labelled_scan.hpp"
#include "rhmap/eval/labels.hpp"
#include "rhmap/io/scan_sequence.hpp"

namespace rhmap::tools {

/// The cells of this edge [m] most of whose labelled points moved; a tie is static, as in the protocol `rhmap`. Calls
/// `progress` after each scan. Throws std::runtime_error for scans without labels.
KeySet movingCells(const io::ScanSequence& sequence, const eval::SequenceWindow& window, double resolution,
                   const std::function<void()>& progress);

/// Whether one of these cells lies in the leaf with this smallest key and depth.
bool holdsOneOf(const KeySet& cells, const OcTreeKey& corner, unsigned depth);

}  // namespace rhmap::tools
