// SPDX-License-Identifier: BSD-3-Clause
#include "occupied_cells.hpp"

#include "arguments.hpp"
#include "rhmap/io/cloud_writer.hpp"

namespace rhmap::tools {

void writeCloud(const std::string& path, std::span<const octomap::point3d> points) {
  extensionOf(path) == ".ply" ? io::writePly(path, points) : io::writePcd(path, points);
}

}  // namespace rhmap::tools
