// SPDX-License-Identifier: BSD-3-Clause
// rhmap convert: a map from one file format to another.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "arguments.hpp"
#include "load_map.hpp"
#include "occupied_cells.hpp"
#include "rhmap/core/atomic_file.hpp"
#include "verbs.hpp"

namespace rhmap::tools {
namespace {

struct ConvertOptions {
  std::string input;
  std::string output;
};

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
  if (isCloud(extension)) {
    const auto cells = visitTree(*map.tree, [&](const auto& tree) { return occupiedCells(options.input, tree); });
    writeCloud(options.output, cells);
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
      ->check(outputFile(kMapAndCloudExtensions));
  verb->group("Verbs");
  verb->footer(kFooter);
  verb->callback([options] { convert(*options); });
}

}  // namespace rhmap::tools
