// SPDX-License-Identifier: BSD-3-Clause
// rhmap_removal_bench: what the removal of dynamic objects takes a scan, stage by stage, and along a drive. Exit codes:
// 0 done, 1 failed, 2 called wrongly.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../statistics.hpp"
#include "processor_name.hpp"
#include "removal_benchmark.hpp"
#include "rhmap/core/atomic_file.hpp"

namespace rhmap::bench {
namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  data/unpack.sh && rhmap_removal_bench build/data/kitti_raw_0005 --json removal.json\n"
    "  rhmap simulate drive drive --frames 4000\n"
    "  rhmap_removal_bench drive --profile default --rounds 1 --window 500";

struct Options {
  std::vector<std::string> sequences;
  std::string json;
  RemovalBenchConfig config;
};

std::string milliseconds(double seconds) { return fmt::format("{:.2f}", seconds * 1e3); }
std::string megabytes(double bytes) { return fmt::format("{:.1f}", bytes / 1e6); }

std::string nameOfSequence(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).lexically_normal();
  return folder.has_filename() ? folder.filename().string() : folder.parent_path().filename().string();
}

/// A table in Markdown: rows that begin with text, the others numbers.
void printTable(const std::vector<std::vector<std::string>>& rows) {
  for (std::size_t r = 0; r < rows.size(); ++r) {
    fmt::print("| {} |\n", fmt::join(rows[r], " | "));
    if (r == 0) fmt::print("| ---{} |\n", fmt::join(std::vector<std::string>(rows[r].size(), ""), " | ---:"));
  }
  fmt::print("\n");
}

void printStages(const std::vector<RemovalRow>& rows) {
  std::vector<std::vector<std::string>> table{{"ms a scan"}};
  for (const RemovalRow& row : rows) table[0].push_back(row.profile);
  const auto addLine = [&](const std::string& name, auto&& seconds) {
    table.push_back({name});
    for (const RemovalRow& row : rows) table.back().push_back(milliseconds(seconds(row)));
  };
  for (std::size_t s = 0; s < kStages; ++s)
    addLine(std::string(nameOf(static_cast<Stage>(s))),
            [s](const RemovalRow& row) { return tools::median(row.stages[s]); });
  addLine("all, median", [](const RemovalRow& row) { return tools::median(row.totals); });
  addLine("all, 95th percentile", [](const RemovalRow& row) { return tools::quantile(row.totals, 0.95); });
  addLine("finish(), once", [](const RemovalRow& row) { return row.finish; });
  printTable(table);
}

void printWindows(const RemovalRow& row) {
  fmt::print("{}:\n\n", row.profile);
  std::vector<std::vector<std::string>> table{
      {"scans", "way [m]", "points", "ms a scan", "removal [MB]", "tree [MB]", "process [MB]"}};
  for (const Window& w : row.windows)
    table.push_back({fmt::format("{}-{}", w.first, w.last), fmt::format("{:.0f}", w.way),
                     fmt::format("{:.0f}", w.points), milliseconds(w.seconds), megabytes(w.removal), megabytes(w.tree),
                     megabytes(w.resident)});
  printTable(table);
}

template <class F>
nlohmann::ordered_json stagesToJson(F&& seconds) {
  nlohmann::ordered_json json;
  for (std::size_t s = 0; s < kStages; ++s) json[std::string(nameOf(static_cast<Stage>(s)))] = seconds(s);
  return json;
}

nlohmann::ordered_json toJson(const Window& window) {
  return {{"first_scan", window.first},
          {"last_scan", window.last},
          {"way_m", window.way},
          {"points", window.points},
          {"median_stage_s", stagesToJson([&](std::size_t s) { return window.stages[s]; })},
          {"median_scan_s", window.seconds},
          {"removal_bytes", window.removal},
          {"tree_bytes", window.tree},
          {"process_bytes", window.resident}};
}

nlohmann::ordered_json toJson(const RemovalRow& row) {
  nlohmann::ordered_json json{
      {"profile", row.profile},
      {"removed_cubes", row.removed},
      {"median_stage_s", stagesToJson([&](std::size_t s) { return tools::median(row.stages[s]); })},
      {"median_scan_s", tools::median(row.totals)},
      {"percentile_95_scan_s", tools::quantile(row.totals, 0.95)},
      {"finish_s", row.finish},
      {"scan_s", row.totals},
      {"windows", nlohmann::ordered_json::array()}};
  for (const Window& window : row.windows) json["windows"].push_back(toJson(window));
  return json;
}

void run(const Options& options) {
  const RemovalBenchConfig& config = options.config;
  nlohmann::ordered_json json{{"processor", processorName()},
                              {"compiler", __VERSION__},
                              {"resolution", config.resolution},
                              {"rounds", config.rounds},
                              {"sequences", nlohmann::ordered_json::array()}};
  for (const std::string& path : options.sequences) {
    const std::vector<RemovalRow> rows = benchmarkRemoval(*io::openSequence(path), config);
    const std::size_t scans = rows.front().totals.size();
    fmt::print("{}, {} scans, {} m, rounds: {}\n\n", nameOfSequence(path), scans, config.resolution, config.rounds);
    printStages(rows);
    nlohmann::ordered_json result{{"sequence", path}, {"scans", scans}};
    for (const RemovalRow& row : rows) {
      if (config.window) printWindows(row);
      result["profiles"].push_back(toJson(row));
    }
    std::fflush(stdout);
    json["sequences"].push_back(std::move(result));
  }
  if (!options.json.empty()) writeFileWhole(options.json, [&](std::ostream& out) { out << json.dump(1) << '\n'; });
}

int parseAndRun(int argc, char** argv) {
  Options options;
  CLI::App app("What the removal of dynamic objects takes: processor times of one thread, stage by stage.",
               "rhmap_removal_bench");
  app.add_option("SEQUENCE", options.sequences, "recorded scans, as rhmap build takes them")->required();
  app.add_option("--profile", options.config.profiles, "profiles to measure, turn and turn about")
      ->check(CLI::IsMember(std::vector<std::string>(removalProfiles().begin(), removalProfiles().end())))
      ->capture_default_str();
  app.add_option("--resolution", options.config.resolution, "edge of the smallest cubes [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--scans", options.config.scans, "only the first scans")->check(CLI::PositiveNumber);
  app.add_option("--rounds", options.config.rounds, "times that each profile maps a sequence")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--window", options.config.window, "besides, medians of time and memory over so many scans in a row")
      ->check(CLI::PositiveNumber);
  app.add_option("--json", options.json, "file for the raw results");
  app.footer(kFooter);
  try {
    app.parse(argc, argv);
    run(options);
    return 0;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "rhmap_removal_bench: {}; see rhmap_removal_bench --help\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "rhmap_removal_bench: {}\n", error.what());
    return 1;
  }
}

}  // namespace
}  // namespace rhmap::bench

int main(int argc, char** argv) { return rhmap::bench::parseAndRun(argc, argv); }
