// SPDX-License-Identifier: BSD-3-Clause
// rhmap clean: the scans of a sequence become a map without what moved.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "arguments.hpp"
#include "occupied_cells.hpp"
#include "removal_options.hpp"
#include "removal_run.hpp"
#include "rhmap/core/atomic_file.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "statistics.hpp"
#include "text.hpp"
#include "verbs.hpp"
#include "written_file.hpp"

namespace rhmap::tools {
namespace {

struct CleanOptions {
  std::string sequence;
  std::vector<std::string> maps;
  std::string profile = "default";
  RemovalOptions removal;
  std::string json;
};

struct CleanSummary {
  CleanOptions options;
  FrameRange frames;
  RemovalFigures figures;
  std::size_t occupied = 0;  ///< cubes of the map
  std::vector<WrittenFile> files;
};

constexpr const char* kFooter =
    "SEQUENCE is what `rhmap build` reads. Scan by scan, what has moved away is taken out of the map and what\n"
    "moves is kept out of it:\n"
    "  paper    RH-Map as published\n"
    "  fast     its 2D scan context and back end, and only cubes that the scan sees through\n"
    "  default  the same, and whatever appears in space that was free for long does not enter\n"
    "MAP is a map (.bt, .ot) or the centres of its occupied cells (.ply, .pcd). Points nearer than --min-range\n"
    "are the carrier's own. Times are processor times, of one thread. The examples want data/unpack.sh to have\n"
    "run.\n"
    "\n"
    "Examples:\n"
    "  rhmap clean build/data/kitti_raw_0005 clean.bt --frames 0-9\n"
    "  rhmap clean build/data/kitti_raw_0005 clean.ot clean.ply --frames 0-4 --profile fast --json summary.json\n"
    "  rhmap clean build/data/kitti_raw_0005 clean.bt --frames 0-4 --resolution 0.2 --front-end-only";

std::size_t countOccupied(const OcTree& map) {
  std::size_t count = 0;
  for (auto leaf = map.begin_leafs(); leaf != map.end_leafs(); ++leaf) {
    if (map.isNodeOccupied(*leaf)) count += numCells(leaf.getDepth());
  }
  return count;
}

WrittenFile writeAs(const std::string& path, const OcTree& map) {
  const std::string extension = extensionOf(path);
  if (isCloud(extension)) {
    writeCloud(path, occupiedCells(path, map));
  } else if (extension == ".ot") {
    writeFileWhole(path, [&](std::ostream& out) { map.write(out); });
  } else {
    OcTree most_likely(map);  // which writeBinary() makes of a map
    writeFileWhole(path, [&](std::ostream& out) { most_likely.writeBinary(out); });
  }
  return writtenFile(path);
}

std::string toText(const CleanSummary& summary) {
  const auto row = [](std::string_view label, double seconds) {
    return fmt::format("{:<24}{:>14}\n", label, fmt::format("{:.2f} ms", 1e3 * seconds));
  };
  const RemovalFigures& figures = summary.figures;
  std::string text =
      fmt::format("sequence  {}, scans {}-{}\n", summary.options.sequence, summary.frames.first, summary.frames.last);
  text += fmt::format("settings  profile {}, {}\n", summary.options.profile, toText(summary.options.removal));
  text += fmt::format("scans     {}\n", grouped(figures.scans));
  text += fmt::format("points    {}, and {} dropped\n", grouped(figures.points), grouped(figures.dropped));
  text += fmt::format("cubes     {} inserted (once a scan), {} rejected, {} removed, {} in the map\n\n",
                      grouped(figures.inserted), grouped(figures.rejected), grouped(figures.removed),
                      grouped(summary.occupied));
  text += row("time per scan, median", median(figures.seconds));
  for (std::size_t s = 0; s < kStages; ++s)
    text += row(fmt::format("  {}", nameOf(static_cast<Stage>(s))), median(figures.stage_seconds[s]));
  text += row("time per scan, mean", figures.meanSeconds());
  return text + "\n" + toText(summary.files);
}

nlohmann::ordered_json toJson(const CleanSummary& summary) {
  const RemovalOptions& removal = summary.options.removal;
  nlohmann::ordered_json json{{"sequence", summary.options.sequence},
                              {"first_scan", summary.frames.first},
                              {"last_scan", summary.frames.last},
                              {"profile", summary.options.profile}};
  json.update(toJson(removal));
  json.update(toJson(summary.figures));
  json["occupied_cubes"] = summary.occupied;
  json["files"] = toJson(summary.files);
  return json;
}

void clean(const CleanOptions& options) {
  requireExists(options.sequence);
  const auto sequence = io::openSequence(options.sequence);
  CleanSummary summary{.options = options,
                       .frames = chooseFrames(options.removal.frames, options.sequence, sequence->size()),
                       .figures = {},
                       .files = {}};
  RhMap map(options.removal.resolution, removalConfig(options.profile, options.removal));
  summary.figures = runRemoval(*sequence, summary.frames, map, "cleaning");
  summary.occupied = countOccupied(map);
  for (const std::string& path : options.maps) summary.files.push_back(writeAs(path, map));
  if (options.json != "-") fmt::print("{}", toText(summary));
  if (!options.json.empty()) writeJson(options.json, toJson(summary));
}

}  // namespace

void addClean(CLI::App& app) {
  const auto options = std::make_shared<CleanOptions>();
  CLI::App* verb = app.add_subcommand("clean", "Build a map of the scans without what moves");
  verb->add_option("SEQUENCE", options->sequence, "Scans with poses")->required()->type_name("");
  verb->add_option("MAP", options->maps, "Files to write, .bt, .ot, .ply or .pcd")
      ->required()
      ->type_name("")
      ->check(outputFile(kMapAndCloudExtensions));
  verb->add_option("--profile", options->profile, "One of: " + profileNames())
      ->type_name("NAME")
      ->capture_default_str()
      ->check(profileName());
  addRemovalOptions(*verb, options->removal);
  addJson(*verb, options->json, "the summary");
  verb->group("Verbs");
  verb->footer(kFooter);
  verb->callback([options] { clean(*options); });
}

}  // namespace rhmap::tools
