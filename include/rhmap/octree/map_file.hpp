// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>

#include "rhmap/octree/abstract_occupancy_octree.hpp"

namespace rhmap {

/// The two file formats of OctoMap: .bt (maximum likelihood, two bits a child) and .ot (all values).
enum class MapFormat { kBinary, kFull };

/// The text header of a map file.
struct MapHeader {
  std::string id;         ///< tree type, e.g. "OcTree"
  unsigned size = 0;      ///< number of nodes, inner ones and the root included
  double resolution = 0;  ///< edge length of a cell [m]; six digits in the file
};

/// The format that a stream's first line announces, if it is one; the stream stands after that line.
std::optional<MapFormat> readMagicLine(std::istream& s);

/// The rest of the header, up to the first byte of data. Throws std::runtime_error that says what is wrong.
MapHeader readMapHeader(std::istream& s);

void writeMapHeader(std::ostream& s, MapFormat format, const MapHeader& header);

/// Fills a tree from a .bt stream (also the headerless form from before OctoMap 1.0); resolution included. Throws
/// std::runtime_error that says what is wrong; the tree is then empty and keeps its resolution.
void readBinaryMap(std::istream& s, AbstractOccupancyOcTree& tree);

/// Reads a .ot stream into a new tree of the type it names. Throws std::runtime_error that says what is wrong.
std::unique_ptr<AbstractOcTree> readFullMap(std::istream& s);

/// Reads a .bt or .ot file, whichever it is; .bt gives an OcTree. Throws std::runtime_error that names the file and
/// says what is wrong.
std::unique_ptr<AbstractOcTree> readMapFile(const std::filesystem::path& file);

}  // namespace rhmap
