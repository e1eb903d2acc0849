// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rhmap {

using octomap::pose6d;

/// One map of a collection file: its name, its .bt file and its pose in the frame of the collection.
struct MapCollectionEntry {
  std::string id;
  std::filesystem::path map_file;
  pose6d pose;  ///< map to collection
};

/// Reads OctoMap's text file of a collection of maps. Three lines a map, in this order:
///
///     MAPNODEID <id>
///     MAPNODEFILENAME <file.bt>             (relative to the folder of this file)
///     MAPNODEPOSE <x y z roll pitch yaw>    [m], [rad]
///
/// Blank lines and lines that begin with # count for nothing; the first word of the others is not looked at, as OctoMap
/// does not look at it. The map files are not opened. Throws std::runtime_error that names file, line and reason.
std::vector<MapCollectionEntry> readMapCollectionFile(const std::filesystem::path& file);

/// Writes a collection: the maps beside `file` as nodemap_<id>.bt, then `file`. `entries` need no map_file; they get
/// one. `write_map(i, path)` is to write the map of entry i to a path, and to return whether it did.
///
/// All maps are written under other names before any old file is replaced, so that a full disk or a map that fails
/// leaves everything as it was. Throws std::runtime_error that names file and reason. What a file name or a line cannot
/// hold is changed: an entry without an id gets its number as one, line breaks become blanks, slashes in file names
/// underscores, and a file name that another entry has already gets a number.
void writeMapCollection(const std::filesystem::path& file, std::vector<MapCollectionEntry> entries,
                        const std::function<bool(std::size_t, const std::filesystem::path&)>& write_map);

}  // namespace rhmap
