// SPDX-License-Identifier: BSD-3-Clause
// rhmap report: a page that shows what rhmap makes of a sequence.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "compare_options.hpp"
#include "moving_cells.hpp"
#include "progress_bar.hpp"
#include "removal_options.hpp"
#include "report_page.hpp"
#include "sensor_path.hpp"
#include "text.hpp"
#include "verbs.hpp"
#include "written_file.hpp"

namespace rhmap::tools {
namespace {

struct ReportOptions {
  ComparisonOptions comparison;
  std::string profile = "default";
  std::string output;
};

constexpr const char* kFooter =
    "DIR gets index.html, one page that needs neither other files nor a network, and what is in it: the pictures\n"
    "(before.png, octomap.png, after.png, difference.png), comparison.json and scans.csv. The page has a summary,\n"
    "pictures with what is left of what moved in red, the maps in 3D side by side, scores by protocol (for a\n"
    "sequence with labels), time and memory scan by scan, the settings, and the commands to do it again.\n"
    "SEQUENCE and options are those of `rhmap compare`. The examples want data/unpack.sh to have run.\n\n"
    "Examples:\n"
    "  rhmap report build/data/kitti_raw_0005 -o report --frames 0-3 --resolution 0.2 --max-range 50\n"
    "  rhmap report data/maps/spherical_scan.graph -o one_scan --min-range 0 --profile fast";

/// The map of all cubes in a set: every hit, and no ray that would erase anything.
OcTree mapOf(const KeySet& cubes, double resolution) {
  OcTree map(resolution);
  for (const OcTreeKey& cube : cubes) map.updateNode(cube, true, true);
  map.updateInnerOccupancy();
  return map;
}

void makeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw std::runtime_error(fmt::format("{}: cannot be made a folder", folder.string()));
}

void report(ReportOptions options) {
  makeFolder(options.output);
  options.comparison.profiles = {options.profile};
  const Comparison comparison = compareMappers(options.comparison, {});
  const double resolution = options.comparison.mapping.resolution;
  const OcTree everything = mapOf(comparison.hits, resolution);
  const auto sequence = io::openSequence(options.comparison.sequence);
  ReportMaps maps{.everything = &everything,
                  .octomap = comparison.octomap.get(),
                  .cleaned = comparison.cleaned.front().map.get(),
                  .moving = {},
                  .has_labels = sequence->hasLabels(),
                  .path = sensorPath(*sequence, comparison.frames)};
  if (maps.has_labels) {
    ProgressBar bar("labels", comparison.frames.last - comparison.frames.first + 1);
    maps.moving = movingCells(*sequence, windowOf(comparison), resolution, [&bar] { bar.advance(); });
  }
  const std::vector<ReportPicture> pictures = drawPictures(maps);

  std::vector<WrittenFile> files;
  const auto write = [&](const std::string& name, const std::string& bytes) {
    const std::string path = (std::filesystem::path(options.output) / name).string();
    writeText(path, bytes);
    files.push_back(writtenFile(path));
  };
  for (const ReportPicture& picture : pictures) write(picture.name + ".png", picture.png);
  write("comparison.json", toJson(comparison).dump(2) + "\n");
  write("scans.csv", toCsv(comparison));
  write("index.html", reportPage(comparison, maps, pictures));
  fmt::print("{}\n{}", toText(comparison), toText(std::span<const WrittenFile>(files)));
  if (const std::string missing = missingViewer(); !missing.empty()) fmt::print("note      {}\n", missing);
}

}  // namespace

void addReport(CLI::App& app) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* verb = app.add_subcommand("report", "Make a page that shows maps, scores and times of a sequence");
  addComparisonOptions(*verb, options->comparison);
  verb->add_option("-o,--output", options->output, "Folder for the page, made if need be")
      ->required()
      ->type_name("DIR");
  verb->add_option("--profile", options->profile, "Removal, one of: " + profileNames())
      ->type_name("NAME")
      ->capture_default_str()
      ->check(profileName());
  verb->group("Verbs");
  verb->footer(kFooter);
  verb->callback([options] { report(*options); });
}

}  // namespace rhmap::tools
