// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arguments.hpp"
#include "rhmap/io/scan_sequence.hpp"

namespace rhmap::tools {

/// Where the sensor was, scan by scan, in the world frame [m].
std::vector<Eigen::Vector3d> sensorPath(const io::ScanSequence& sequence, const FrameRange& frames);

}  // namespace rhmap::tools
