// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rhmap::io {

/// One number of a point in a file; `where` of the three coordinates it is, or -1.
struct CloudField {
  std::size_t bytes = 4;
  bool is_float = true;
  int where = -1;
};

/// What the header of a cloud says: how its points lie in the rest of the file.
struct CloudLayout {
  bool ascii = false;
  std::uint64_t points = 0;
  std::vector<CloudField> fields;
  std::uint64_t body = 0;        ///< where the points begin [byte]
  std::size_t header_lines = 0;  ///< lines before them

  /// Adds `count` fields named `name`; the first of x, y, z are the coordinates.
  void add(const std::string& name, std::size_t bytes, bool is_float, std::size_t count = 1);

  /// Throws, naming the file, unless there are an x, a y and a z of 4 or 8 bytes.
  void check(const std::filesystem::path& file) const;
};

CloudLayout readPcdHeader(const std::filesystem::path& file);
CloudLayout readPlyHeader(const std::filesystem::path& file);

}  // namespace rhmap::io
