// SPDX-License-Identifier: BSD-3-Clause
#include "removal_benchmark.hpp"

#include <malloc.h>

#include <algorithm>

#include "../statistics.hpp"
#include "rhmap/baseline/resident_memory.hpp"

namespace rhmap::bench {
namespace {

/// One profile's way through the sequence.
struct Run {
  std::vector<ScanReport> reports;
  ScanReport finish;
  std::vector<double> way;           // up to a scan [m]
  std::vector<MemorySample> memory;  // every few scans; empty without windows
};

/// Scans from one look at the memory to the next: it takes a walk through all that the removal keeps.
std::size_t scansBetweenSamples(std::size_t window) { return std::max<std::size_t>(1, window / 50); }

Run runOnce(const io::ScanSequence& sequence, const std::string& profile, const RemovalBenchConfig& config,
            std::size_t scans) {
  RhMap map(config.resolution, removalProfile(profile));
  Run run;
  octomap::point3d last;
  for (std::size_t i = 0; i < scans; ++i) {
    const io::Scan scan = sequence.scan(i);
    run.reports.push_back(map.insertScan(scan.points, scan.pose));
    const double step = i == 0 ? 0 : (scan.pose.trans() - last).norm();
    run.way.push_back((i == 0 ? 0 : run.way.back()) + step);
    last = scan.pose.trans();
    if (config.window && i % scansBetweenSamples(*config.window) == 0)
      run.memory.push_back({map.removalMemoryUsage(), map.memoryUsage(), residentMemory().value_or(0)});
  }
  run.finish = map.finish();
  return run;
}

/// Median over the rounds, scan by scan.
template <class F>
std::vector<double> overRounds(const std::vector<Run>& rounds, F&& secondsOf) {
  std::vector<double> result;
  for (std::size_t i = 0; i < rounds.front().reports.size(); ++i) {
    std::vector<double> values;
    for (const Run& run : rounds) values.push_back(secondsOf(run.reports[i]));
    result.push_back(tools::median(std::move(values)));
  }
  return result;
}

std::vector<Window> windowsOf(const Run& run, const RemovalRow& row, std::size_t size) {
  const auto memoryAt = [&](std::size_t i) { return run.memory[i / scansBetweenSamples(size)]; };
  std::vector<Window> windows;
  for (std::size_t first = 0; first < row.totals.size(); first += size) {
    const std::size_t last = std::min(first + size, row.totals.size()) - 1;
    const auto medianOf = [&](auto&& value) {
      std::vector<double> values;
      for (std::size_t i = first; i <= last; ++i) values.push_back(static_cast<double>(value(i)));
      return tools::median(std::move(values));
    };
    windows.push_back({.first = first,
                       .last = last,
                       .way = run.way[last],
                       .points = medianOf([&](std::size_t i) { return run.reports[i].points; }),
                       .seconds = medianOf([&](std::size_t i) { return row.totals[i]; }),
                       .stages = {},
                       .removal = medianOf([&](std::size_t i) { return memoryAt(i).removal; }),
                       .tree = medianOf([&](std::size_t i) { return memoryAt(i).tree; }),
                       .resident = medianOf([&](std::size_t i) { return memoryAt(i).resident; })});
    for (std::size_t s = 0; s < kStages; ++s)
      windows.back().stages[s] = medianOf([&](std::size_t i) { return row.stages[s][i]; });
  }
  return windows;
}

RemovalRow rowOf(const std::string& profile, const std::vector<Run>& rounds, const RemovalBenchConfig& config) {
  RemovalRow row{.profile = profile, .stages = {}, .totals = {}, .windows = {}};
  for (std::size_t s = 0; s < kStages; ++s)
    row.stages[s] = overRounds(rounds, [s](const ScanReport& report) { return report.seconds[s]; });
  row.totals = overRounds(rounds, [](const ScanReport& report) { return report.totalSeconds(); });

  std::vector<double> finish;
  for (const Run& run : rounds) finish.push_back(run.finish.totalSeconds());
  row.finish = tools::median(std::move(finish));

  const Run& run = rounds.front();
  row.removed = run.finish.removed;
  for (const ScanReport& report : run.reports) row.removed += report.removed;
  if (config.window) row.windows = windowsOf(run, row, *config.window);
  return row;
}

}  // namespace

std::vector<RemovalRow> benchmarkRemoval(const io::ScanSequence& sequence, const RemovalBenchConfig& config) {
  const std::size_t scans = std::min(config.scans.value_or(sequence.size()), sequence.size());
  std::vector<std::vector<Run>> runs(config.profiles.size());
  for (std::size_t round = 0; round < config.rounds; ++round) {
    for (std::size_t p = 0; p < config.profiles.size(); ++p) {
      runs[p].push_back(runOnce(sequence, config.profiles[p], config, scans));
      malloc_trim(0);  // the next one starts with a tidy heap
    }
  }
  std::vector<RemovalRow> rows;
  for (std::size_t p = 0; p < config.profiles.size(); ++p) rows.push_back(rowOf(config.profiles[p], runs[p], config));
  return rows;
}

}  // namespace rhmap::bench
