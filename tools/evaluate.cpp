// SPDX-License-Identifier: BSD-3-Clause
// rhmap evaluate: how well a map is cleaned of what moves.
#include "rhmap/eval/evaluate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "ablation.hpp"
#include "arguments.hpp"
#include "evaluate_options.hpp"
#include "evaluation_table.hpp"
#include "load_map.hpp"
#include "mapper_rows.hpp"
#include "octomap_rows.hpp"
#include "paper_tables.hpp"
#include "paper_windows.hpp"
#include "rhmap/io/cloud_reader.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "text.hpp"
#include "verbs.hpp"

namespace rhmap::tools {
namespace {

constexpr std::array<std::string_view, 3> kProtocols{"rhmap", "erasor", "kth"};
constexpr std::array<std::string_view, 7> kMapFiles{".bt", ".ot", ".pcd", ".ply", ".xyz", ".txt", ".dat"};

/// Options that only a run of the mapper reads.
constexpr std::array<const char*, 3> kMapperOptions{"--region-size", "--free-space", "--front-end-only"};

constexpr const char* kFooter =
    "SEQUENCE has labels in SemanticKITTI's layout (labels/NNNNNN.label): classes 251-259 move, 0 is not\n"
    "counted. The rows of the mapper are those of `rhmap clean` with the same options, one a profile; with them\n"
    "come the scores while the map grew (protocol online) and the processor time of a scan. --map FILE adds\n"
    "what another method left, an occupancy map (.bt, .ot) or points in the world frame (.pcd, .ply, .xyz,\n"
    ".txt, .dat), and alone it leaves the mapper out. Two rows are always there: `no removal` keeps everything,\n"
    "`oracle` leaves out exactly the points labelled as moving. --tables looks for SEQUENCE/sequences/NN and\n"
    "SEQUENCE/NN. Rates are in per cent but F1, a dash where there is nothing to divide by; doc/evaluation.md\n"
    "has the protocols. The examples want data/unpack.sh to have run.\n"
    "\n"
    "Examples:\n"
    "  rhmap evaluate build/data/kitti_raw_0005 --frames 0-4\n"
    "  rhmap evaluate build/data/kitti_raw_0005 --frames 0-4 --profile fast,default --json scores.json\n"
    "  rhmap evaluate build/data/kitti_raw_0005 --frames 0-4 --front-end-only --protocol rhmap,kth\n"
    "  rhmap evaluate build/data/kitti_raw_0005 --frames 0-1 --octomap --protocol rhmap\n"
    "  rhmap evaluate build/data/kitti_raw_0005 --frames 0-1 --ablation\n"
    "  rhmap evaluate build/data --tables --windows kitti_raw_0005:0-4 --profile default";

CLI::Validator mapFile() {
  return CLI::Validator(
      [](std::string& path) -> std::string {
        const std::string extension = extensionOf(path);
        if (std::find(kMapFiles.begin(), kMapFiles.end(), extension) != kMapFiles.end()) return "";
        return fmt::format("{} has no known extension; one of: {}", path, fmt::join(kMapFiles, ", "));
      },
      "");
}

/// A map or cloud of another method, and its row, which looks into it.
struct MapElsewhere {
  explicit MapElsewhere(const std::string& path) {
    requireExists(path);
    const std::string name = std::filesystem::path(path).filename().string();
    if (extensionOf(path) == ".bt" || extensionOf(path) == ".ot") {
      map = loadMap(path);
      row = visitTree(*map.tree, [&name](const auto& tree) { return eval::keptInMap(name, tree); });
    } else {
      row = eval::keptInCloud(name, io::readCloud(path));
    }
  }
  LoadedMap map;
  eval::Estimate row;
};

/// The ablation's, or the profiles that were asked for; the default's, if neither they nor a map were.
std::vector<MapperRow> rowsOf(const EvaluateOptions& options) {
  if (options.ablation) return ablationRows(options.removal);
  std::vector<std::string> profiles = options.profiles;
  if (profiles.empty() && options.map.empty()) profiles.push_back("default");
  std::vector<MapperRow> rows;
  for (const std::string& profile : profiles) rows.push_back({profile, removalConfig(profile, options.removal)});
  return rows;
}

nlohmann::ordered_json summaryOf(const EvaluateOptions& options, const FrameRange& frames,
                                 std::span<const eval::Score> scores, std::span<const MapperRun> runs) {
  nlohmann::ordered_json json{{"sequence", options.sequence}, {"first_scan", frames.first}, {"last_scan", frames.last}};
  json.update(toJson(options.removal));
  if (!options.map.empty()) json["map"] = options.map;
  json["rows"] = toJson(scores);
  json["runs"] = toJson(runs);
  return json;
}

void evaluate(const EvaluateOptions& options) {
  requireExists(options.sequence);
  std::optional<MapElsewhere> map;  // lives as long as its row
  if (!options.map.empty()) map.emplace(options.map);
  const auto sequence = io::openSequence(options.sequence);
  const FrameRange frames = chooseFrames(options.removal.frames, options.sequence, sequence->size());
  requireLabels(options.sequence, *sequence);

  std::vector<eval::Estimate> elsewhere;
  if (map) elsewhere.push_back(map->row);
  const eval::EvaluationConfig config = evaluationConfig(options, frames);
  std::optional<OctomapBaseline> octomap;  // lives as long as its rows
  if (options.octomap) {
    octomap = runOctomapBaseline(*sequence, config.window, options.removal.resolution);
    for (eval::Estimate& row : octomapRows(*octomap->map, octomap->ground)) elsewhere.push_back(std::move(row));
  }
  auto [runs, scores] = evaluateRows(*sequence, config, options.removal.resolution, rowsOf(options), elsewhere, "");
  const std::vector<eval::Score> online = onlineScores(runs);
  scores.insert(scores.end(), online.begin(), online.end());
  if (options.json != "-") {
    fmt::print("sequence  {}, scans {}-{}\n", options.sequence, frames.first, frames.last);
    if (!runs.empty()) fmt::print("settings  {}\n", toText(options.removal));
    fmt::print("{}{}", toTable(scores), runs.empty() ? "" : timeTable(runs));
  }
  if (!options.json.empty()) writeJson(options.json, summaryOf(options, frames, scores, runs));
}

void tables(EvaluateOptions options) {
  if (std::find(options.protocols.begin(), options.protocols.end(), "kth") != options.protocols.end())
    throw UsageError("--tables are of PR and RR, which protocol kth has not; one of: rhmap, erasor");
  if (options.profiles.empty()) options.profiles.assign(removalProfiles().begin(), removalProfiles().end());
  evaluateTables(options);
}

/// An option that nothing reads would be a wish that is not granted in silence.
void requireMapper(const CLI::App& verb, const EvaluateOptions& options) {
  if (options.map.empty() || !options.profiles.empty() || options.ablation) return;
  for (const char* option : kMapperOptions) {
    if (verb.count(option) > 0)
      throw UsageError(
          fmt::format("{} is for a run of the mapper, which --map alone leaves out; add --profile, any of: {}", option,
                      profileNames()));
  }
}

}  // namespace

void addEvaluate(CLI::App& app) {
  const auto options = std::make_shared<EvaluateOptions>();
  CLI::App* verb = app.add_subcommand("evaluate", "Score how well a map is cleaned of what moves");
  verb->add_option("SEQUENCE", options->sequence, "Scans with poses and labels")->required()->type_name("");
  verb->add_option("--map", options->map, "Cleaned map or cloud to score")->type_name("FILE")->check(mapFile());
  verb->add_option("--profile", options->profiles,
                   fmt::format("Any of: {} (default: default, or none with --map)", profileNames()))
      ->type_name("NAMES")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(profileName());
  verb->add_option("--protocol", options->protocols,
                   fmt::format("Any of: {} (default: all)", fmt::join(kProtocols, ", ")))
      ->type_name("NAMES")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(oneOf("protocol", kProtocols));
  addRemovalOptions(*verb, options->removal);
  verb->add_flag("--octomap", options->octomap, "Rows of what OctoMap's rays leave, with and without the ground kept");
  verb->add_option("--ego-radius", options->ego_radius,
                   "Protocol kth: nearer points of classes 0 and 1 move; 3 in DynamicMap_Benchmark")
      ->type_name("M")
      ->capture_default_str()
      ->check(lengthFrom0());
  verb->add_flag("--ablation", options->ablation, "Rows of the profiles with one part changed, under protocol rhmap")
      ->excludes("--profile", "--region-size", "--front-end-only");
  verb->add_flag(
          "--tables", options->tables,
          "The paper's Tables I and II; SEQUENCE is the folder of SemanticKITTI, rows are --profile's (default: all)")
      ->excludes("--ablation", "--map", "--octomap", "--frames", "--front-end-only");
  verb->add_option("--windows", options->windows, "Scans of the tables (default: " + paperWindows() + ")")
      ->type_name("SEQUENCE:A-B,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(windowOfSequence())
      ->needs("--tables");
  addJson(*verb, options->json, "counts, rates and times");
  verb->group("Verbs");
  verb->footer(kFooter);
  verb->callback([options, verb] {
    requireMapper(*verb, *options);
    if ((options->ablation || options->tables) && options->protocols.empty()) options->protocols = {"rhmap"};
    options->tables ? tables(*options) : evaluate(*options);
  });
}

}  // namespace rhmap::tools
