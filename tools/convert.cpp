// SPDX-License-Identifier: BSD-3-Clause
// rhmap convert: a map from one file format to another.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "arguments.hpp"
#include "load_map.hpp"
#include "rhmap/core/atomic_file.hpp"
#include "rhmap/io/cloud_writer.hpp"
#include "verbs.hpp"

namespace rhmap::tools {
namespace {

struct ConvertOptions {
  std::string input;
  std::string output;
};

constexpr std::array<std::string_view, 4> kExtensions{".bt", ".ot", ".ply", ".pcd"};
constexpr int kTreeDepth = 16;
constexpr std::uint64_t kMaxCells = 1'000'000'000;  ///< 12 GB of points; more is a mistake rather than a wish

constexpr const char* kFooter =
    "The first line of IN says what it is, the extension of OUT what it becomes:\n"
    "  .bt    most likely states. From .ot: pruned like OctoMap's writeBinary(); from .bt: byte for byte the same\n"
    "  .ot    all log-odds. From .bt: those of the clamping thresholds; from .ot: byte for byte the same, colours too\n"
    "  .ply, .pcd  centres of the occupied cells, all of the finest size: a larger leaf gives one point for each of "
    "the\n"
    "         smallest cubes in it, in the order of the tree\n"
    "OUT is written whole or not at all.\n\n"
    "Examples:\n"
    "  rhmap convert data/maps/geb079.bt map.ot\n"
    "  rhmap convert data/maps/geb079.bt cells.ply\n"
    "  rhmap convert data/maps/geb079.bt cells.pcd";

/// Bits 0, 3, 6, ... of a number, packed: one axis of a Morton index.
unsigned everyThirdBit(std::uint64_t index) {
  unsigned bits = 0;
  for (int i = 0; i < kTreeDepth; ++i) bits |= static_cast<unsigned>(index >> (3 * i) & 1U) << i;
  return bits;
}

std::uint64_t numCells(unsigned depth) { return std::uint64_t{1} << (3 * (kTreeDepth - static_cast<int>(depth))); }

/// Centres [m] of the occupied cells, larger leaves cut into the smallest cubes in the order of expanded leaves.
template <class TREE>
std::vector<octomap::point3d> occupiedCells(const std::string& path, const TREE& tree) {
  std::uint64_t count = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (tree.isNodeOccupied(*leaf)) count += numCells(leaf.getDepth());
    if (count > kMaxCells)
      throw std::runtime_error(fmt::format("{}: more than {} occupied cells, too many for a cloud", path, kMaxCells));
  }
  std::vector<octomap::point3d> points;
  points.reserve(count);
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const octomap::OcTreeKey corner = leaf.getIndexKey();
    for (std::uint64_t i = 0; i < numCells(leaf.getDepth()); ++i) {
      octomap::OcTreeKey key = corner;
      for (unsigned axis = 0; axis < 3; ++axis)
        key[axis] = static_cast<octomap::key_type>(key[axis] + everyThirdBit(i >> axis));
      points.push_back(tree.keyToCoord(key));
    }
  }
  return points;
}

/// The tree as it is, under the id that its file had; whole or not at all.
void writeMap(const std::string& path, MapFormat format, const LoadedMap& map) {
  writeFileWhole(path, [&](std::ostream& out) {
    writeMapHeader(out, format, map.header);
    if (map.tree->size() == 0) return;
    format == MapFormat::kBinary ? map.tree->writeBinaryData(out) : map.tree->writeData(out);
  });
}

void convert(const ConvertOptions& options) {
  const std::string extension = extensionOf(options.output);
  LoadedMap map = loadMap(options.input);
  if (extension == ".ply" || extension == ".pcd") {
    const auto cells = visitTree(*map.tree, [&](const auto& tree) { return occupiedCells(options.input, tree); });
    extension == ".ply" ? io::writePly(options.output, cells) : io::writePcd(options.output, cells);
    return;
  }
  const MapFormat format = extension == ".bt" ? MapFormat::kBinary : MapFormat::kFull;
  if (format == MapFormat::kBinary && map.format == MapFormat::kFull) {
    map.tree->toMaxLikelihood();
    map.tree->prune();
  }
  if (format == MapFormat::kFull) map.header.id = map.tree->getTreeType();
  map.header.size = static_cast<unsigned>(map.tree->size());
  writeMap(options.output, format, map);
}

}  // namespace

void addConvert(CLI::App& app) {
  const auto options = std::make_shared<ConvertOptions>();
  CLI::App* verb = app.add_subcommand("convert", "Convert a map to another file format");
  verb->add_option("IN", options->input, "Map to read, .bt or .ot")->required()->type_name("");
  verb->add_option("OUT", options->output, "File to write, .bt, .ot, .ply or .pcd")
      ->required()
      ->type_name("")
      ->check(outputFile(kExtensions));
  verb->group("Verbs");
  verb->footer(kFooter);
  verb->callback([options] { convert(*options); });
}

}  // namespace rhmap::tools
