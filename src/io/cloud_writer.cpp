// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/io/cloud_writer.hpp"

#include <array>
#include <bit>
#include <ostream>
#include <string>

#include "rhmap/core/atomic_file.hpp"

namespace rhmap::io {

namespace {

static_assert(std::endian::native == std::endian::little, "floats are written as they are");

void writeCloud(const std::filesystem::path& file, const std::string& header,
                std::span<const octomap::point3d> points) {
  writeFileWhole(file, [&](std::ostream& stream) {
    stream << header;
    for (const octomap::point3d& point : points) {
      const std::array<float, 3> xyz{point.x(), point.y(), point.z()};
      stream.write(reinterpret_cast<const char*>(xyz.data()), sizeof(xyz));
    }
  });
}

}  // namespace

void writePly(const std::filesystem::path& file, std::span<const octomap::point3d> points) {
  writeCloud(file,
             "ply\n"
             "format binary_little_endian 1.0\n"
             "element vertex " +
                 std::to_string(points.size()) +
                 "\n"
                 "property float x\n"
                 "property float y\n"
                 "property float z\n"
                 "end_header\n",
             points);
}

void writePcd(const std::filesystem::path& file, std::span<const octomap::point3d> points) {
  const std::string size = std::to_string(points.size());
  writeCloud(file,
             "# .PCD v0.7 - Point Cloud Data file format\n"
             "VERSION 0.7\n"
             "FIELDS x y z\n"
             "SIZE 4 4 4\n"
             "TYPE F F F\n"
             "COUNT 1 1 1\n"
             "WIDTH " +
                 size +
                 "\n"
                 "HEIGHT 1\n"
                 "VIEWPOINT 0 0 0 1 0 0 0\n"
                 "POINTS " +
                 size +
                 "\n"
                 "DATA binary\n",
             points);
}

}  // namespace rhmap::io
