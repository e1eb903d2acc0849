// SPDX-License-Identifier: BSD-3-Clause
#include "mapper_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "progress_bar.hpp"
#include "rhmap/eval/online_score.hpp"
#include "statistics.hpp"

namespace rhmap::tools {
namespace {

MapperRun run(const io::ScanSequence& sequence, const eval::EvaluationConfig& config, double resolution,
              const MapperRow& row, const std::string& label) {
  const FrameRange frames{config.window.first, config.window.last.value_or(sequence.size() - 1)};
  RhMap map(resolution, row.config);
  const eval::Estimate now = eval::keptInMap(row.name, map);
  eval::OnlineScore online(config.labels, kOnlineLag);
  MapperRun result;
  result.name = row.name;
  result.figures = runRemoval(sequence, frames, map, label, [&](const io::Scan& scan, const RhMap&) {
    online.add(eval::labelledScan(scan, config.window), now);
  });
  result.at_insertion = online.atOnce();
  result.later = online.later();
  result.map = std::make_unique<OcTree>(map);
  return result;
}

std::string milliseconds(double seconds) { return fmt::format("{:>10.2f}", 1e3 * seconds); }

}  // namespace

Evaluation evaluateRows(const io::ScanSequence& sequence, const eval::EvaluationConfig& config, double resolution,
                        std::span<const MapperRow> rows, std::span<const eval::Estimate> elsewhere,
                        const std::string& label) {
  Evaluation evaluation;
  for (const MapperRow& row : rows)
    evaluation.runs.push_back(
        run(sequence, config, resolution, row, label.empty() ? row.name : label + " " + row.name));
  std::vector<eval::Estimate> estimates;
  for (const MapperRun& run : evaluation.runs) estimates.push_back(eval::keptInMap(run.name, *run.map));
  estimates.insert(estimates.end(), elsewhere.begin(), elsewhere.end());
  ProgressBar bar("evaluating", eval::numReads(sequence, config));
  evaluation.scores = eval::evaluate(sequence, config, estimates, [&bar] { bar.advance(); });
  return evaluation;
}

std::vector<eval::Score> onlineScores(std::span<const MapperRun> runs) {
  std::vector<eval::Score> scores;
  for (const MapperRun& run : runs) {
    scores.push_back({.protocol = "online", .row = run.name + ", at insertion", .points = run.at_insertion});
    scores.push_back(
        {.protocol = "online", .row = fmt::format("{}, {} scans later", run.name, kOnlineLag), .points = run.later});
  }
  return scores;
}

std::string timeTable(std::span<const MapperRun> runs) {
  std::size_t width = 14;
  for (const MapperRun& run : runs) width = std::max(width, run.name.size());
  std::string text =
      fmt::format("\nprocessor time of a scan [ms]: mean, median, medians of its stages\n{:<{}}{:>10}{:>10}", "", width,
                  "mean", "median");
  for (std::size_t s = 0; s < kStages; ++s) text += fmt::format("{:>10}", nameOf(static_cast<Stage>(s)));
  text += "\n";
  for (const MapperRun& run : runs) {
    text += fmt::format("{:<{}}", run.name, width) + milliseconds(run.figures.meanSeconds()) +
            milliseconds(median(run.figures.seconds));
    for (const std::vector<double>& seconds : run.figures.stage_seconds) text += milliseconds(median(seconds));
    text += "\n";
  }
  return text;
}

nlohmann::ordered_json toJson(std::span<const MapperRun> runs) {
  auto json = nlohmann::ordered_json::array();
  for (const MapperRun& run : runs) {
    nlohmann::ordered_json row{{"row", run.name}};
    row.update(toJson(run.figures));
    json.push_back(row);
  }
  return json;
}

}  // namespace rhmap::tools
