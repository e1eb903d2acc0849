// SPDX-License-Identifier: BSD-3-Clause
// rhmap evaluate: how well a map was cleaned of what moves.
#include "rhmap/eval/evaluate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "evaluation_table.hpp"
#include "load_map.hpp"
#include "progress_bar.hpp"
#include "rhmap/io/cloud_reader.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "text.hpp"
#include "verbs.hpp"

namespace rhmap::tools {
namespace {

struct EvaluateOptions {
  std::string sequence;
  std::string map;  ///< cleaned map or cloud; empty: none
  double resolution = eval::RhmapConfig{}.resolution;
  std::optional<double> max_range;
  double min_range = 0;
  double ego_radius = eval::KthConfig{}.ego_radius;
  std::string frames;
  std::vector<std::string> protocols{"rhmap", "erasor", "kth"};
  std::string json;
};

constexpr std::array<std::string_view, 3> kProtocols{"rhmap", "erasor", "kth"};
constexpr std::array<std::string_view, 7> kMapFiles{".bt", ".ot", ".pcd", ".ply", ".xyz", ".txt", ".dat"};

constexpr const char* kFooter =
    "SEQUENCE has labels in SemanticKITTI's layout (labels/NNNNNN.label): classes 251-259 move, 0 is not counted.\n"
    "FILE is what a method left: an occupancy map (.bt, .ot) or points in the world frame (.pcd, .ply, .xyz, .txt, "
    ".dat).\n"
    "Two rows are always there: `no removal` keeps everything, `oracle` leaves out exactly the points labelled as "
    "moving.\n"
    "Rates are in per cent but F1, a dash where there is nothing to divide by; doc/evaluation.md has the protocols.\n"
    "The examples want data/unpack.sh to have run.\n\n"
    "Examples:\n"
    "  rhmap evaluate build/data/kitti_raw_0005 --frames 0-9\n"
    "  rhmap evaluate build/data/kitti_raw_0005 --frames 0-4 --min-range 2.7 --protocol rhmap,kth --json scores.json";

CLI::Validator mapFile() {
  return CLI::Validator(
      [](std::string& path) -> std::string {
        const std::string extension = extensionOf(path);
        if (std::find(kMapFiles.begin(), kMapFiles.end(), extension) != kMapFiles.end()) return "";
        return fmt::format("{} has no known extension; one of: {}", path, fmt::join(kMapFiles, ", "));
      },
      "");
}

bool asksFor(const EvaluateOptions& options, const char* protocol) {
  return std::find(options.protocols.begin(), options.protocols.end(), protocol) != options.protocols.end();
}

eval::EvaluationConfig configOf(const EvaluateOptions& options, const FrameRange& frames) {
  eval::EvaluationConfig config{.window = {.first = frames.first,
                                           .last = frames.last,
                                           .min_range = options.min_range,
                                           .max_range = options.max_range},
                                .labels = eval::Labels()};
  config.rhmap->resolution = options.resolution;
  config.kth->ego_radius = options.ego_radius;
  if (!asksFor(options, "rhmap")) config.rhmap.reset();
  if (!asksFor(options, "erasor")) config.erasor.reset();
  if (!asksFor(options, "kth")) config.kth.reset();
  return config;
}

nlohmann::ordered_json summaryOf(const EvaluateOptions& options, const FrameRange& frames,
                                 std::span<const eval::Score> scores) {
  nlohmann::ordered_json json{{"sequence", options.sequence}, {"first_scan", frames.first},
                              {"last_scan", frames.last},     {"min_range_m", options.min_range},
                              {"max_range_m", nullptr},       {"resolution_m", options.resolution}};
  if (options.max_range) json["max_range_m"] = *options.max_range;
  if (!options.map.empty()) json["map"] = options.map;
  json["rows"] = toJson(scores);
  return json;
}

void evaluate(const EvaluateOptions& options) {
  requireExists(options.sequence);
  LoadedMap map;  // lives as long as the rows
  std::vector<eval::Estimate> rows;
  if (!options.map.empty()) {
    requireExists(options.map);
    const std::string name = std::filesystem::path(options.map).filename().string();
    if (extensionOf(options.map) == ".bt" || extensionOf(options.map) == ".ot") {
      map = loadMap(options.map);
      rows.push_back(visitTree(*map.tree, [&name](const auto& tree) { return eval::keptInMap(name, tree); }));
    } else {
      rows.push_back(eval::keptInCloud(name, io::readCloud(options.map)));
    }
  }
  const auto sequence = io::openSequence(options.sequence);
  const FrameRange frames = chooseFrames(options.frames, options.sequence, sequence->size());
  if (!sequence->hasLabels())
    throw std::runtime_error(options.sequence + ": has no labels (labels/NNNNNN.label) to score against");

  const eval::EvaluationConfig config = configOf(options, frames);
  std::vector<eval::Score> scores;
  {
    ProgressBar bar("evaluating", eval::numReads(*sequence, config));
    scores = eval::evaluate(*sequence, config, rows, [&bar] { bar.advance(); });
  }
  if (options.json != "-")
    fmt::print("sequence  {}, scans {}-{}\n{}", options.sequence, frames.first, frames.last, toTable(scores));
  if (!options.json.empty()) writeJson(options.json, summaryOf(options, frames, scores));
}

}  // namespace

void addEvaluate(CLI::App& app) {
  const auto options = std::make_shared<EvaluateOptions>();
  CLI::App* verb = app.add_subcommand("evaluate", "Score how well a map was cleaned of what moves");
  verb->add_option("SEQUENCE", options->sequence, "Scans with poses and labels")->required()->type_name("");
  verb->add_option("--map", options->map, "Cleaned map or cloud to score (default: the baselines only)")
      ->type_name("FILE")
      ->check(mapFile());
  verb->add_option("--protocol", options->protocols, fmt::format("Any of: {}", fmt::join(kProtocols, ", ")))
      ->type_name("NAMES")
      ->delimiter(',')
      ->default_str("rhmap,erasor,kth")
      ->check(oneOf("protocol", kProtocols));
  verb->add_option("--resolution", options->resolution, "Edge of the cubes of protocol rhmap")
      ->type_name("M")
      ->capture_default_str()
      ->check(lengthAbove0());
  verb->add_option("--max-range", options->max_range, "Distance beyond which points are dropped (default: none)")
      ->type_name("M")
      ->check(lengthAbove0());
  addMinRange(*verb, options->min_range);
  verb->add_option("--ego-radius", options->ego_radius,
                   "Protocol kth: nearer points of classes 0 and 1 move; 3 in DynamicMap_Benchmark")
      ->type_name("M")
      ->capture_default_str()
      ->check(lengthFrom0());
  addFrames(*verb, options->frames);
  verb->add_option("--json", options->json, "Write counts and rates as JSON, - for stdout")
      ->type_name("FILE")
      ->check(outputFileOrStdout());
  verb->group("Verbs");
  verb->footer(kFooter);
  verb->callback([options] { evaluate(*options); });
}

}  // namespace rhmap::tools
