// SPDX-License-Identifier: BSD-3-Clause
#include "written_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "text.hpp"

namespace rhmap::tools {

WrittenFile writtenFile(const std::string& path) { return {path, std::filesystem::file_size(path)}; }

std::string toText(std::span<const WrittenFile> files) {
  std::string text;
  for (const WrittenFile& file : files) text += fmt::format("written   {} ({})\n", file.path, byteSize(file.bytes));
  return text;
}

nlohmann::ordered_json toJson(std::span<const WrittenFile> files) {
  auto json = nlohmann::ordered_json::array();
  for (const WrittenFile& file : files) json.push_back({{"path", file.path}, {"bytes", file.bytes}});
  return json;
}

}  // namespace rhmap::tools
