// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/map_file.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <istream>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string_view>

#include "rhmap/core/failure.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {
namespace {

constexpr std::string_view kBinaryMagic = "# Octomap OcTree binary file";
constexpr std::string_view kFullMagic = "# Octomap OcTree file";

void skipLine(std::istream& s) { s.ignore(std::numeric_limits<std::streamsize>::max(), '\n'); }

template <class T>
T takeRaw(std::istream& s) {
  std::array<char, sizeof(T)> bytes;
  if (!s.read(bytes.data(), sizeof(T))) throw std::runtime_error("neither OctoMap's first line nor its oldest header");
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

/// The headerless form from before OctoMap 1.0.
MapHeader readLegacyHeader(std::istream& s) {
  constexpr int kTreeType = 3;
  if (takeRaw<std::int32_t>(s) != kTreeType)
    throw std::runtime_error("the first line is not \"" + std::string(kBinaryMagic) + "\"");
  MapHeader header{.id = "OcTree"};
  header.resolution = takeRaw<double>(s);
  header.size = takeRaw<std::uint32_t>(s);
  return header;
}

void requireSane(const MapHeader& header) {
  if (header.id.empty()) throw std::runtime_error("the header has no id");
  // OctoMap's test, and an upper bound, so that what follows is arithmetic and not chance.
  if (!(header.resolution > 0) || header.resolution > 1e6)
    throw std::runtime_error("the header's resolution is not above 0 [m]");
}

MapHeader readBinaryHeader(std::istream& s) {
  const std::istream::pos_type start = s.tellg();
  if (readMagicLine(s) == MapFormat::kBinary) return readMapHeader(s);
  s.clear();
  s.seekg(start);
  const MapHeader header = readLegacyHeader(s);
  requireSane(header);
  return header;
}

std::ifstream openFile(const std::filesystem::path& file) {
  std::ifstream s(file, std::ios::binary);
  if (!s || std::filesystem::is_directory(file)) throw std::runtime_error("it cannot be opened");
  return s;
}

}  // namespace

std::optional<MapFormat> readMagicLine(std::istream& s) {
  std::string line;
  std::getline(s, line);
  if (line.starts_with(kBinaryMagic)) return MapFormat::kBinary;
  if (line.starts_with(kFullMagic)) return MapFormat::kFull;
  return std::nullopt;
}

MapHeader readMapHeader(std::istream& s) {
  MapHeader header;
  const auto number = [&s](auto& field, const char* name) {
    if (!(s >> field)) throw std::runtime_error(std::string("the header's ") + name + " is not a number");
  };
  for (std::string token; s >> token;) {
    if (token == "data") {
      skipLine(s);
      if (header.id == "1") header.id = "OcTree";  // an old alias
      requireSane(header);
      return header;
    }
    if (token == "id") {
      s >> header.id;
    } else if (token == "res") {
      number(header.resolution, "resolution");
    } else if (token == "size") {
      number(header.size, "size");
    } else {
      skipLine(s);  // a comment, or a field from the future
    }
  }
  throw std::runtime_error("the header does not end with a line \"data\"");
}

void writeMapHeader(std::ostream& s, MapFormat format, const MapHeader& header) {
  s << (format == MapFormat::kBinary ? kBinaryMagic : kFullMagic)
    << "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
    << "id " << header.id << "\nsize " << header.size << "\nres " << header.resolution << "\ndata\n";
}

void readBinaryMap(std::istream& s, AbstractOccupancyOcTree& tree) {
  tree.clear();
  const MapHeader header = readBinaryHeader(s);
  const double resolution = tree.getResolution();
  tree.setResolution(header.resolution);
  const bool complete = header.size == 0 || !tree.readBinaryData(s).fail();
  if (complete && tree.size() == header.size) return;
  const std::string found = std::to_string(tree.size());
  tree.clear();
  tree.setResolution(resolution);
  throw std::runtime_error(complete
                               ? "the header promises " + std::to_string(header.size) + " nodes, the data have " + found
                               : std::string("the data end or break in the middle of the tree"));
}

std::unique_ptr<AbstractOcTree> readFullMap(std::istream& s) {
  if (readMagicLine(s) != MapFormat::kFull)
    throw std::runtime_error("the first line is not \"" + std::string(kFullMagic) + "\"");
  const MapHeader header = readMapHeader(s);
  std::unique_ptr<AbstractOcTree> tree(AbstractOcTree::createTree(header.id, header.resolution));
  if (!tree) throw std::runtime_error("there is no tree type \"" + header.id + "\" here");
  if (header.size > 0 && tree->readData(s).fail())
    throw std::runtime_error("the data end or break in the middle of the tree");
  // The node count is not held against the file: the data end where they end, and OctoMap itself writes a wrong count
  // after it has deleted an inner node.
  return tree;
}

std::unique_ptr<AbstractOcTree> readMapFile(const std::filesystem::path& file) try {
  std::ifstream s = openFile(file);
  const std::optional<MapFormat> format = readMagicLine(s);
  s.clear();
  s.seekg(0);
  if (format == MapFormat::kFull) return readFullMap(s);
  auto tree = std::make_unique<OcTree>(0.1);
  readBinaryMap(s, *tree);
  return tree;
} catch (const std::runtime_error& reason) {
  failOnFile(file, reason.what());
}

}  // namespace rhmap
