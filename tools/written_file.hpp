// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace rhmap::tools {

/// A file that a verb left, for its summary.
struct WrittenFile {
  std::string path;
  std::uintmax_t bytes = 0;
};

/// The file as it is on disk now.
WrittenFile writtenFile(const std::string& path);

/// A line a file.
std::string toText(std::span<const WrittenFile> files);

/// An array of path and bytes.
nlohmann::ordered_json toJson(std::span<const WrittenFile> files);

}  // namespace rhmap::tools
