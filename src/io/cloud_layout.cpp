// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_layout.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <sstream>

#include "rhmap/core/failure.hpp"

namespace rhmap::io {
namespace {

/// The header's lines as words, up to and including that for which `last` holds.
template <class Last>
std::vector<std::vector<std::string>> headerLines(const std::filesystem::path& file, CloudLayout& layout, Last last) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) failOnFile(file, "cannot be opened");
  std::vector<std::vector<std::string>> lines;
  constexpr std::size_t kMostLines = 1000;
  for (std::string line; lines.size() < kMostLines && std::getline(stream, line);) {
    std::istringstream words(line);
    auto& in = lines.emplace_back();
    for (std::string word; words >> word;) in.push_back(word);
    if (!in.empty() && last(in)) {
      layout.body = static_cast<std::uint64_t>(stream.tellg());
      layout.header_lines = lines.size();
      return lines;
    }
  }
  failOnFile(file, "has no header that ends");
}

std::uint64_t number(const std::filesystem::path& file, const std::vector<std::string>& line, std::size_t word) {
  std::uint64_t value = 0;
  if (word >= line.size()) failOnFile(file, "the header's " + line[0] + " lacks a value");
  const std::string& text = line[word];
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    failOnFile(file, "the header's " + line[0] + " is not a number: '" + text + "'");
  return value;
}

}  // namespace

void CloudLayout::add(const std::string& name, std::size_t bytes, bool is_float, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k)
    fields.push_back({bytes, is_float, k > 0 ? -1 : name == "x" ? 0 : name == "y" ? 1 : name == "z" ? 2 : -1});
}

void CloudLayout::check(const std::filesystem::path& file) const {
  for (int where = 0; where < 3; ++where) {
    const auto fits = [where](const CloudField& field) { return field.where == where; };
    if (std::count_if(fields.begin(), fields.end(), fits) != 1)
      failOnFile(file, "wants one x, one y and one z a point");
    const CloudField& field = *std::find_if(fields.begin(), fields.end(), fits);
    if (!field.is_float || (field.bytes != 4 && field.bytes != 8)) failOnFile(file, "x, y and z are not floats");
  }
}

CloudLayout readPcdHeader(const std::filesystem::path& file) {
  CloudLayout layout;
  std::map<std::string, std::vector<std::string>> header;
  for (auto& line : headerLines(file, layout, [](const auto& words) { return words[0] == "DATA"; })) {
    if (!line.empty()) header[line[0]] = line;
  }
  for (const char* key : {"FIELDS", "SIZE", "TYPE"}) {
    if (!header.contains(key) || header[key].size() != header["FIELDS"].size())
      failOnFile(file, std::string("the header's ") + key + " is missing or does not fit FIELDS");
  }
  constexpr std::size_t kMostNumbers = 10000;
  for (std::size_t k = 1; k < header["FIELDS"].size(); ++k) {
    const std::uint64_t count = header.contains("COUNT") ? number(file, header["COUNT"], k) : 1;
    const std::uint64_t bytes = number(file, header["SIZE"], k);
    if (count > kMostNumbers || bytes > 8) failOnFile(file, "the header's SIZE or COUNT is absurd");
    layout.add(header["FIELDS"][k], bytes, header["TYPE"][k] == "F", count);
  }
  if (!header.contains("POINTS")) failOnFile(file, "the header's POINTS is missing");
  layout.points = number(file, header["POINTS"], 1);
  const std::string data = header["DATA"].size() > 1 ? header["DATA"][1] : "";
  if (data != "ascii" && data != "binary")
    failOnFile(file, "DATA " + data + " cannot be read; one of: ascii, binary (pcl_convert_pcd_ascii_binary converts)");
  layout.ascii = data == "ascii";
  layout.check(file);
  return layout;
}

CloudLayout readPlyHeader(const std::filesystem::path& file) {
  static const std::map<std::string, std::size_t> kBytes{{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},
                                                         {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
                                                         {"int", 4},   {"uint", 4},    {"int32", 4},  {"uint32", 4},
                                                         {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  CloudLayout layout;
  std::string format;
  std::size_t elements = 0;
  const auto lines = headerLines(file, layout, [](const auto& words) { return words[0] == "end_header"; });
  if (lines[0].empty() || lines[0][0] != "ply") failOnFile(file, "is no PLY file: the first line is not 'ply'");
  for (const auto& line : lines) {
    if (line.empty()) continue;
    if (line[0] == "format" && line.size() > 1) format = line[1];
    if (line[0] == "element") {
      if (elements++ == 0 && (line.size() < 3 || line[1] != "vertex"))
        failOnFile(file, "the vertices do not come first");
      if (elements == 1) layout.points = number(file, line, 2);
    }
    if (line[0] == "property" && elements == 1) {
      const auto bytes = line.size() == 3 ? kBytes.find(line[1]) : kBytes.end();
      if (bytes == kBytes.end()) failOnFile(file, "a vertex has a property that is not one number");
      layout.add(line[2], bytes->second, line[1][0] == 'f' || line[1][0] == 'd');
    }
  }
  if (format != "ascii" && format != "binary_little_endian")
    failOnFile(file, "format " + format + " cannot be read; one of: ascii, binary_little_endian");
  layout.ascii = format == "ascii";
  layout.check(file);
  return layout;
}

}  // namespace rhmap::io
