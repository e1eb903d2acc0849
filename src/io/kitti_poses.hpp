// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <filesystem>
#include <vector>

namespace rhmap::io {

/// LiDAR-to-world poses [m] of a KITTI folder, one a line of poses.txt, with the chain of calib.txt applied.
std::vector<octomap::pose6d> readKittiPoses(const std::filesystem::path& folder);

}  // namespace rhmap::io
