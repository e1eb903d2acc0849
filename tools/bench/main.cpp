// SPDX-License-Identifier: BSD-3-Clause
// rhmap_bench: OctoMap and rhmap side by side, in one process, on the same scans and questions. Exit codes: 0 done,
// 1 failed or the answers differ, 2 called wrongly.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "comparison.hpp"
#include "processor_name.hpp"
#include "rhmap/core/atomic_file.hpp"
#include "threads.hpp"

namespace rhmap::bench {
namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  data/unpack.sh && rhmap_bench build/data/kitti_raw_0005 --json bench.json\n"
    "  rhmap_bench build/data/kitti_raw_0005 --resolution 0.2 --only search";

struct Options {
  std::string sequence;
  std::size_t scans = 5;
  std::vector<double> resolutions{0.2, 0.1};
  std::vector<std::string> maps;
  std::string json;
  int threads = static_cast<int>(std::thread::hardware_concurrency());
  ComparisonConfig config;
};

std::string timeText(double seconds) {
  if (seconds < 1e-6) return fmt::format("{:.3g} ns", seconds * 1e9);
  if (seconds < 1e-3) return fmt::format("{:.3g} us", seconds * 1e6);
  return seconds < 1 ? fmt::format("{:.3g} ms", seconds * 1e3) : fmt::format("{:.3g} s", seconds);
}

void print(const Row& row) {
  fmt::print("{:<4} m  {:<54} {:>10} {:>10} a {:<5}{:>7.2f}x{}\n", row.resolution, row.title.name,
             timeText(median(row.octomap)), timeText(median(row.rhmap)), row.title.per, ratio(row),
             row.same_answers ? "" : "  THE ANSWERS DIFFER");
  std::fflush(stdout);
}

void print(const MemoryRow& row) {
  fmt::print("resident memory, {:<44} {:>7.1f} MB {:>7.1f} MB        {:>7.2f}x{}\n", row.map,
             static_cast<double>(row.octomap) / 1e6, static_cast<double>(row.rhmap) / 1e6,
             static_cast<double>(row.octomap) / static_cast<double>(row.rhmap),
             row.same_answers ? "" : "  THE MAPS DIFFER");
  std::fflush(stdout);
}

void print(const ThreadsRow& row) {
  const double one = median(row.one), several = median(row.several);
  fmt::print("{:<4} m  {:<54} {:>10} {:>10} a scan {:>7.2f}x of {:.2f}x{}\n", row.resolution,
             fmt::format("insertPointCloud, 1 and {} threads, by the clock", row.threads), timeText(one),
             timeText(several), one / several, one / median(row.apart), row.same_answers ? "" : "  THE MAPS DIFFER");
  std::fflush(stdout);
}

nlohmann::ordered_json toJson(const Row& row) {
  return {{"resolution", row.resolution},    {"name", row.title.name}, {"per", row.title.per},
          {"operations", row.operations},    {"octomap", row.octomap}, {"rhmap", row.rhmap},
          {"same_answers", row.same_answers}};
}

nlohmann::ordered_json toJson(const MemoryRow& row) {
  return {{"map", row.map},
          {"nodes", row.nodes},
          {"octomap", row.octomap},
          {"rhmap", row.rhmap},
          {"same_answers", row.same_answers}};
}

nlohmann::ordered_json toJson(const ThreadsRow& row) {
  return {{"resolution", row.resolution}, {"threads", row.threads}, {"one", row.one},
          {"several", row.several},       {"apart", row.apart},     {"same_answers", row.same_answers}};
}

/// True if both libraries gave the same answers everywhere.
bool run(const Options& options) {
  nlohmann::ordered_json json{{"processor", processorName()},
                              {"compiler", __VERSION__},
                              {"scans", options.scans},
                              {"variant_scans", options.config.variant_scans},
                              {"rounds", options.config.rounds},
                              {"max_range", options.config.max_range},
                              {"benchmarks", nlohmann::ordered_json::array()},
                              {"memory", nlohmann::ordered_json::array()},
                              {"threads", nlohmann::ordered_json::array()}};
  bool same_answers = true;
  const auto report = [&](const char* list) {
    return [&, list](const auto& row) {
      print(row);
      json[list].push_back(toJson(row));
      same_answers = same_answers && row.same_answers;
    };
  };
  const std::vector<WorldScan> scans = loadScans(options.sequence, options.scans);
  // These first: in a process that OctoMap has not used yet.
  if (options.threads > 1 && options.config.wants("insertPointCloud, threads"))
    for (const double resolution : options.resolutions)
      report("threads")(
          compareThreads(scans, resolution, options.threads, options.config.max_range, options.config.rounds));
  fmt::print("{:<62} {:>10} {:>10}\n", "", "OctoMap", "rhmap");
  for (const double resolution : options.resolutions)
    compare(scans, resolution, options.config, report("benchmarks"), report("memory"));
  for (const std::string& map : options.maps) report("memory")(compareMemory(map));
  if (!options.json.empty()) writeFileWhole(options.json, [&](std::ostream& out) { out << json.dump(1) << '\n'; });
  return same_answers;
}

int parseAndRun(int argc, char** argv) {
  Options options;
  CLI::App app("OctoMap and rhmap side by side: processor times, medians of interleaved runs, and their ratio.",
               "rhmap_bench");
  app.add_option("SEQUENCE", options.sequence, "recorded scans, as rhmap build takes them")->required();
  app.add_option("--scans", options.scans, "scans in the map")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--variant-scans", options.config.variant_scans, "scans for each other way to insert them")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--rounds", options.config.rounds, "runs of everything else")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--resolution", options.resolutions, "edges of the smallest cubes [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--max-range", options.config.max_range, "rays are cut here [m]")->capture_default_str();
  app.add_option("--threads", options.threads, "threads to insert scans by, beside one")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--only", options.config.only, "benchmarks with this in their name");
  app.add_option("--map", options.maps, ".bt files to measure the memory of")->check(CLI::ExistingFile);
  app.add_option("--json", options.json, "file for the raw results");
  app.footer(kFooter);
  try {
    app.parse(argc, argv);
    return run(options) ? 0 : 1;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "rhmap_bench: {}; see rhmap_bench --help\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "rhmap_bench: {}\n", error.what());
    return 1;
  }
}

}  // namespace
}  // namespace rhmap::bench

int main(int argc, char** argv) { return rhmap::bench::parseAndRun(argc, argv); }
