// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/io/cloud_reader.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <string>

#include "add_point.hpp"
#include "binary_file.hpp"
#include "cloud_layout.hpp"
#include "text_line.hpp"

namespace rhmap::io {
namespace {

using Points = std::vector<octomap::point3d>;

void addFinite(Points& points, const std::array<float, 3>& xyz) {
  if (isFinite(xyz[0], xyz[1], xyz[2])) points.emplace_back(xyz[0], xyz[1], xyz[2]);
}

Points readAscii(const std::filesystem::path& file, const CloudLayout& layout) {
  Points points;
  std::uint64_t read = 0;
  forEachLine(file, [&](TextLine& line) {
    if (line.number() <= layout.header_lines || read == layout.points) return;
    if (line.text().find_first_not_of(" \t\r") == std::string_view::npos) return;
    std::array<float, 3> xyz{};
    for (const CloudField& field : layout.fields) {
      if (field.where < 0) {
        line.word();
      } else {
        xyz[static_cast<std::size_t>(field.where)] = line.readFloat("a coordinate");
      }
    }
    addFinite(points, xyz);
    ++read;
  });
  if (read < layout.points)
    failOnFile(file, std::to_string(layout.points) + " points wanted, but there are only " + std::to_string(read));
  return points;
}

float coordinate(const char* bytes, const CloudField& field) {
  if (field.bytes == 4) {
    float value;
    std::memcpy(&value, bytes, sizeof(value));
    return value;
  }
  double value;
  std::memcpy(&value, bytes, sizeof(value));
  return static_cast<float>(value);
}

Points readBinary(const std::filesystem::path& path, const CloudLayout& layout) {
  std::size_t stride = 0;
  for (const CloudField& field : layout.fields) stride += field.bytes;
  BinaryFile file(path);
  file.seek(layout.body);
  file.require(layout.points, stride, "a point");
  Points points;
  points.reserve(static_cast<std::size_t>(layout.points));
  constexpr std::uint64_t kAtOnce = 1 << 16;
  for (std::uint64_t read = 0; read < layout.points;) {
    const std::uint64_t count = std::min(kAtOnce, layout.points - read);
    const std::vector<char> bytes = file.readArray<char>(count * stride, "points");
    for (const char* at = bytes.data(); at != bytes.data() + bytes.size();) {
      std::array<float, 3> xyz{};
      for (const CloudField& field : layout.fields) {
        if (field.where >= 0) xyz[static_cast<std::size_t>(field.where)] = coordinate(at, field);
        at += field.bytes;
      }
      addFinite(points, xyz);
    }
    read += count;
  }
  return points;
}

Points readLines(const std::filesystem::path& file) {
  Points points;
  forEachLine(file, [&points](TextLine& line) {
    const std::size_t first = line.text().find_first_not_of(" \t");
    if (first == std::string_view::npos || line.text()[first] == '#') return;
    const float x = line.readFloat("x of a point");
    const float y = line.readFloat("y of a point");
    const float z = line.readFloat("z of a point");
    addFinite(points, {x, y, z});
  });
  return points;
}

}  // namespace

std::vector<octomap::point3d> readCloud(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".xyz" || extension == ".txt" || extension == ".dat") return readLines(file);
  if (extension != ".pcd" && extension != ".ply") failOnFile(file, "is no cloud; one of: .pcd, .ply, .xyz, .txt, .dat");
  const CloudLayout layout = extension == ".pcd" ? readPcdHeader(file) : readPlyHeader(file);
  return layout.ascii ? readAscii(file, layout) : readBinary(file, layout);
}

}  // namespace rhmap::io
