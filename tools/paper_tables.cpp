// SPDX-License-Identifier: BSD-3-Clause
#include "paper_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "evaluation_table.hpp"
#include "mapper_rows.hpp"
#include "paper_figures.hpp"
#include "paper_windows.hpp"
#include "text.hpp"

namespace rhmap::tools {
namespace {

constexpr const char* kFrontEnd = ", front end only";

/// Two rows a profile, as in the paper: front end only, and both.
std::vector<MapperRow> rowsOf(const EvaluateOptions& options) {
  std::vector<MapperRow> rows;
  for (const std::string& profile : options.profiles) {
    MapperRow both{profile, removalConfig(profile, options.removal)};
    MapperRow front_end{profile + kFrontEnd, both.config};
    front_end.config.back_end.enabled = false;
    rows.push_back(front_end);
    rows.push_back(both);
  }
  return rows;
}

/// What the paper says of exactly this window; null for others.
const PublishedWindow* publishedOf(const Window& window) {
  const auto found = std::find_if(kPublished.begin(), kPublished.end(), [&](const PublishedWindow& published) {
    return published.sequence == window.sequence && published.first == window.numbers.first &&
           published.last == window.numbers.last;
  });
  return found == kPublished.end() ? nullptr : &*found;
}

struct Result {
  Window window;
  Evaluation evaluation;
};

std::string rate(std::optional<double> value, double unit, int digits) {
  return value ? fmt::format("{:>9.{}f}", unit * *value, digits) : fmt::format("{:>9}", "-");
}

/// Whether there is anything to put beside the results.
bool anyPublished(std::span<const Result> results) {
  return std::any_of(results.begin(), results.end(), [](const Result& r) { return publishedOf(r.window) != nullptr; });
}

/// The first two columns of a row; names of sequences may be longer than SemanticKITTI's.
std::string heading(std::span<const Result> results, std::string_view sequence, std::string_view row) {
  std::size_t width = 6;
  for (const Result& result : results) width = std::max(width, result.window.sequence.size() + 2);
  return fmt::format("{:<{}}{:<26}", sequence, width, row);
}

/// Table I under one protocol.
std::string scoreTable(std::span<const Result> results, const std::string& protocol) {
  std::string text = fmt::format("\nTable I: PR, RR [%] and F1, protocol {}\n{}{:>9}{:>9}{:>9}", protocol,
                                 heading(results, "seq", ""), "PR", "RR", "F1");
  if (anyPublished(results)) text += fmt::format("{:>14}{:>9}{:>9}", "published PR", "RR", "F1");
  text += "\n";
  for (const Result& result : results) {
    const PublishedWindow* published = publishedOf(result.window);
    for (const eval::Score& score : result.evaluation.scores) {
      if (score.protocol != protocol) continue;
      text += heading(results, result.window.sequence, score.row) + rate(score.cells->staticKept(), 100, 2) +
              rate(score.cells->dynamicRemoved(), 100, 2) + rate(score.cells->harmonicMean(), 1, 4);
      const bool is_run = score.row != "no removal" && score.row != "oracle";
      if (published != nullptr && is_run) {
        const PublishedScore& theirs = score.row.ends_with(kFrontEnd) ? published->front_end : published->both;
        text += fmt::format("{:>14.2f}{:>9.2f}{:>9.4f}", theirs.pr, theirs.rr, theirs.f1);
      }
      text += "\n";
    }
  }
  return text;
}

/// Table II: the mean of a scan, front and back end.
std::string speedTable(std::span<const Result> results) {
  std::string text = fmt::format("\nTable II: processor time of a scan, mean, and scans a second\n{}{:>9}{:>9}",
                                 heading(results, "seq", ""), "ms", "Hz");
  if (anyPublished(results)) text += fmt::format("{:>14}{:>9}", "published ms", "Hz");
  text += "\n";
  for (const Result& result : results) {
    const PublishedWindow* published = publishedOf(result.window);
    for (const MapperRun& run : result.evaluation.runs) {
      if (run.name.ends_with(kFrontEnd)) continue;
      const double seconds = run.figures.meanSeconds();
      text += heading(results, result.window.sequence, run.name) +
              fmt::format("{:>9.2f}{:>9.1f}", 1e3 * seconds, 1 / seconds);
      if (published != nullptr) text += fmt::format("{:>14.2f}{:>9.1f}", published->milliseconds, published->hertz);
      text += "\n";
    }
  }
  return text;
}

nlohmann::ordered_json jsonOf(const PublishedWindow& published) {
  const auto score = [](const PublishedScore& theirs) {
    return nlohmann::ordered_json{{"PR", theirs.pr / 100}, {"RR", theirs.rr / 100}, {"F1", theirs.f1}};
  };
  return {{"front_end", score(published.front_end)},
          {"both", score(published.both)},
          {"mean_scan_s", 1e-3 * published.milliseconds}};
}

nlohmann::ordered_json summaryOf(const EvaluateOptions& options, std::span<const Result> results,
                                 std::span<const FoundWindow> missing) {
  nlohmann::ordered_json json{{"root", options.sequence}};
  json.update(toJson(options.removal));
  json["sequences"] = nlohmann::ordered_json::array();
  for (const Result& result : results) {
    const PublishedWindow* published = publishedOf(result.window);
    json["sequences"].push_back({{"sequence", result.window.sequence},
                                 {"first_scan", result.window.numbers.first},
                                 {"last_scan", result.window.numbers.last},
                                 {"published", published ? jsonOf(*published) : nlohmann::ordered_json(nullptr)},
                                 {"rows", toJson(result.evaluation.scores)},
                                 {"runs", toJson(result.evaluation.runs)}});
  }
  json["missing"] = nlohmann::ordered_json::array();
  for (const FoundWindow& window : missing)
    json["missing"].push_back({{"sequence", window.window.sequence}, {"reason", window.missing}});
  return json;
}

std::string listOf(std::span<const FoundWindow> missing) {
  std::vector<std::string> lines;
  for (const FoundWindow& window : missing) lines.push_back(window.window.sequence + " " + window.missing);
  return fmt::format("{}", fmt::join(lines, "; "));
}

}  // namespace

void evaluateTables(const EvaluateOptions& options) {
  requireExists(options.sequence);
  std::vector<FoundWindow> there, missing;
  for (const Window& window : windowsOf(options.windows)) {
    FoundWindow found = findWindow(options.sequence, window);
    (found.sequence ? there : missing).push_back(std::move(found));
  }
  if (there.empty())
    throw std::runtime_error(
        fmt::format("{}: nothing to evaluate: {}; SemanticKITTI is expected, sequences/NN or NN with "
                    "velodyne, labels, poses.txt and calib.txt",
                    options.sequence, listOf(missing)));
  const auto rows = rowsOf(options);
  std::vector<Result> results;
  for (const FoundWindow& found : there) {
    const eval::EvaluationConfig config = evaluationConfig(options, found.frames);
    results.push_back({found.window, evaluateRows(*found.sequence, config, options.removal.resolution, rows, {},
                                                  found.window.sequence)});
    for (MapperRun& run : results.back().evaluation.runs)
      run.map.reset();  // scored; the next sequence needs the memory
  }
  if (options.json != "-") {
    fmt::print("settings  {}\n", toText(options.removal));
    for (const Result& result : results)
      fmt::print("sequence  {}, scans {}-{}\n", result.window.sequence, result.window.numbers.first,
                 result.window.numbers.last);
    if (!missing.empty()) fmt::print("missing   {}\n", listOf(missing));
    for (const std::string& protocol : options.protocols) fmt::print("{}", scoreTable(results, protocol));
    fmt::print("{}", speedTable(results));
  }
  if (!options.json.empty()) writeJson(options.json, summaryOf(options, results, missing));
}

}  // namespace rhmap::tools
