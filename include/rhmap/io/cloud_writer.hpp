// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <filesystem>
#include <span>

namespace rhmap::io {

/// Writes points [m], e.g. an octomap::Pointcloud or the centres of occupied cells, as PLY (binary little-endian, float
/// x y z); throws std::runtime_error that names file and reason.
void writePly(const std::filesystem::path& file, std::span<const octomap::point3d> points);

/// Writes points [m] as PCD v0.7 (binary, float x y z); throws std::runtime_error that names file and reason.
void writePcd(const std::filesystem::path& file, std::span<const octomap::point3d> points);

}  // namespace rhmap::io
