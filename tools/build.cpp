// SPDX-License-Identifier: BSD-3-Clause
// rhmap build: the scans of a sequence become a map.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "build_summary.hpp"
#include "mapping.hpp"
#include "rhmap/baseline/mapper.hpp"
#include "rhmap/core/atomic_file.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "text.hpp"
#include "verbs.hpp"

namespace rhmap::tools {
namespace {

constexpr std::array<std::string_view, 2> kMapExtensions{".bt", ".ot"};

constexpr const char* kFooter =
    "SEQUENCE is a folder in KITTI's or SemanticKITTI's layout (velodyne/*.bin, poses.txt), a .graph or .log file of\n"
    "OctoMap, or one scan as .dat or .xyz. Points nearer than --min-range are dropped (2.7 drops the car under a "
    "KITTI\n"
    "LiDAR), rays are cut at --max-range.\n"
    "A .bt file holds the most likely state of every cell, pruned, like OctoMap's writeBinary(); an .ot file holds "
    "all\n"
    "log-odds. Resident memory is the physical memory that the process gives back when the map is destroyed;\n"
    "memoryUsage() is what the tree says of itself.\n\n"
    "Examples:\n"
    "  rhmap build data/maps/spherical_scan.graph map.bt\n"
    "  rhmap build data/maps/spherical_scan.graph map.bt map.ot --resolution 0.05 --json summary.json\n"
    "  rhmap build data/maps/spherical_scan.graph map.ot --max-range 20 --compare";

WrittenFile writeMap(const std::string& path, const Mapper& mapper) {
  const auto write = extensionOf(path) == ".bt" ? &Mapper::writeBinary : &Mapper::write;
  writeFileWhole(path, [&](std::ostream& out) { (mapper.*write)(out); });
  return writtenFile(path);
}

void build(const BuildOptions& options) {
  if (options.compare && options.mapper == "octomap")
    throw UsageError("--compare measures rhmap against OctoMap; leave --mapper octomap out");
  requireExists(options.sequence);
  const auto sequence = io::openSequence(options.sequence);
  BuildSummary summary;
  summary.options = options;
  summary.frames = chooseFrames(options.frames, options.sequence, sequence->size());

  std::vector<std::string> kinds{options.mapper};
  if (options.compare) kinds.push_back("octomap");
  MappingRun run(kinds, {.resolution = options.resolution,
                         .max_range = options.max_range,
                         .min_range = options.min_range,
                         .threads = options.threads});
  summary.points = run.insert(*sequence, summary.frames, "building");
  if (options.compare) summary.identity = run.compareBytes();
  for (const std::string& path : options.maps) summary.files.push_back(writeMap(path, run.map(0)));
  summary.maps = run.finish();

  if (options.json != "-") fmt::print("{}", toText(summary));
  if (!options.json.empty()) writeJson(options.json, toJson(summary));
}

}  // namespace

void addBuild(CLI::App& app) {
  const auto options = std::make_shared<BuildOptions>();
  CLI::App* verb = app.add_subcommand("build", "Build a map from the scans of a sequence");
  verb->add_option("SEQUENCE", options->sequence, "Scans with poses")->required()->type_name("");
  verb->add_option("MAP", options->maps, "Files to write, .bt or .ot")
      ->required()
      ->type_name("")
      ->check(outputFile(kMapExtensions));
  addResolution(*verb, options->resolution, "Edge of the smallest cube");
  addMaxRange(*verb, options->max_range, "Length at which rays are cut");
  addMinRange(*verb, options->min_range);
  verb->add_option("--mapper", options->mapper, fmt::format("One of: {}", fmt::join(mapperKinds(), ", ")))
      ->type_name("NAME")
      ->capture_default_str()
      ->check(oneOf("mapper", mapperKinds()));
  addFrames(*verb, options->frames);
  verb->add_option("--threads", options->threads, "Threads of one insertion (rhmap; OctoMap has one)")
      ->type_name("N")
      ->capture_default_str()
      ->check(countFrom1("threads"));
  verb->add_flag("--compare", options->compare, "Build with OctoMap as well and compare time, memory and bytes");
  addJson(*verb, options->json, "the summary");
  verb->group("Verbs");
  verb->footer(kFooter);
  verb->callback([options] { build(*options); });
}

}  // namespace rhmap::tools
