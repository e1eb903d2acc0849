// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rhmap/io/scan_sequence.hpp"

namespace rhmap::eval {

/// A scan as the map sees it; three vectors of the same length.
struct LabelledScan {
  std::vector<octomap::point3d> points;     ///< world frame [m]
  std::vector<octomap::point3d> in_sensor;  ///< the same in the sensor's frame [m]: protocols cut by range
  std::vector<std::uint32_t> labels;        ///< class in the low 16 bits
};

/// Which part of a sequence is evaluated.
struct SequenceWindow {
  std::size_t first = 0;
  std::optional<std::size_t> last = std::nullopt;  ///< included; none: to the end
  double min_range = 0;                            ///< nearer points are left out [m]
  std::optional<double> max_range = std::nullopt;  ///< farther points are left out [m]
};

/// A scan with labels, without the points outside of the window's ranges.
LabelledScan labelledScan(const io::Scan& scan, const SequenceWindow& window);

/// Scan i without the points outside of the window's ranges. Throws std::runtime_error that says which scan has no
/// labels, or cannot be read.
LabelledScan readLabelledScan(const io::ScanSequence& sequence, std::size_t i, const SequenceWindow& window);

}  // namespace rhmap::eval
