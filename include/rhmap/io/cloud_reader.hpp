// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <filesystem>
#include <vector>

namespace rhmap::io {

/// The points [m] of a cloud, by extension: `.pcd` (ascii, binary), `.ply` (ascii, binary little-endian), `.xyz`,
/// `.txt` and `.dat` (lines that begin with x y z). Fields other than x, y, z and a PCD's VIEWPOINT are passed over,
/// points that are not finite left out. Throws std::runtime_error that names file and reason.
std::vector<octomap::point3d> readCloud(const std::filesystem::path& file);

}  // namespace rhmap::io
