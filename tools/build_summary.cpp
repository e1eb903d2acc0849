// SPDX-License-Identifier: BSD-3-Clause
#include "build_summary.hpp"

#include <fmt/format.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "statistics.hpp"
#include "text.hpp"

namespace rhmap::tools {
namespace {

/// OctoMap over rhmap, which stand in this order; nothing without a second map or a zero below the line.
std::optional<double> ratio(const BuildSummary& summary, const std::function<double(const MapFigures&)>& figure) {
  if (summary.maps.size() != 2) return std::nullopt;
  const double below = figure(summary.maps[0]);
  if (!(below > 0)) return std::nullopt;
  return figure(summary.maps[1]) / below;
}

double medianSeconds(const MapFigures& map) { return median(map.seconds); }
double meanSeconds(const MapFigures& map) { return mean(map.seconds); }
double residentBytes(const MapFigures& map) { return static_cast<double>(map.resident_memory.value_or(0)); }

/// A line of the table: label, one cell a mapper, the ratio where there is one.
std::string row(const BuildSummary& summary, const char* label,
                const std::function<std::string(const MapFigures&)>& cell,
                std::optional<double> octomap_over_rhmap = std::nullopt) {
  std::string line = fmt::format("{:<24}", label);
  for (const MapFigures& map : summary.maps) line += fmt::format("{:>14}", cell(map));
  if (octomap_over_rhmap) line += fmt::format("{:>12.1f} x", *octomap_over_rhmap);
  return line + "\n";
}

std::string scansText(const BuildSummary& summary) {
  const BuildOptions& options = summary.options;
  std::string text =
      fmt::format("sequence  {}, scans {}-{}\n", options.sequence, summary.frames.first, summary.frames.last);
  text += fmt::format("settings  resolution {} m, range {} m to {}, {}\n", options.resolution, options.min_range,
                      options.max_range ? fmt::format("{} m", *options.max_range) : "any",
                      options.threads == 1 ? "1 thread" : fmt::format("{} threads", options.threads));
  text += fmt::format("scans     {}\n", grouped(summary.frames.last - summary.frames.first + 1));
  text +=
      fmt::format("points    {}, and {} dropped\n", grouped(summary.points.inserted), grouped(summary.points.dropped));
  return text;
}

}  // namespace

std::string toText(const BuildSummary& summary) {
  const auto milliseconds = [](double seconds) { return fmt::format("{:.2f} ms", 1e3 * seconds); };
  std::string text = scansText(summary) + "\n";
  text += row(summary, "", [](const MapFigures& map) { return map.mapper; });
  text += row(summary, "nodes", [](const MapFigures& map) { return grouped(map.nodes); });
  text += row(summary, "leaves", [](const MapFigures& map) { return grouped(map.leaves); });
  text += row(
      summary, "time per scan, median", [&](const MapFigures& map) { return milliseconds(medianSeconds(map)); },
      ratio(summary, medianSeconds));
  text += row(
      summary, "time per scan, mean", [&](const MapFigures& map) { return milliseconds(meanSeconds(map)); },
      ratio(summary, meanSeconds));
  text += row(
      summary, "resident memory",
      [](const MapFigures& map) { return map.resident_memory ? byteSize(*map.resident_memory) : "unknown"; },
      ratio(summary, residentBytes));
  text += row(summary, "memoryUsage()", [](const MapFigures& map) { return byteSize(map.memory_usage); });
  text += "\n";
  if (summary.identity) {
    const auto verdict = [](bool same) { return same ? "identical" : "DIFFERENT"; };
    text += fmt::format("bytes     .ot {}, .bt {}\n", verdict(summary.identity->ot), verdict(summary.identity->bt));
  }
  return text + toText(summary.files);
}

nlohmann::ordered_json toJson(const BuildSummary& summary) {
  const auto orNull = [](const auto& value) { return value ? nlohmann::ordered_json(*value) : nullptr; };
  const BuildOptions& options = summary.options;
  nlohmann::ordered_json json{
      {"sequence", options.sequence},      {"first_scan", summary.frames.first},
      {"last_scan", summary.frames.last},  {"resolution_m", options.resolution},
      {"min_range_m", options.min_range},  {"max_range_m", orNull(options.max_range)},
      {"threads", options.threads},        {"scans", summary.frames.last - summary.frames.first + 1},
      {"points", summary.points.inserted}, {"dropped_points", summary.points.dropped}};
  json["maps"] = nlohmann::ordered_json::array();
  for (const MapFigures& map : summary.maps) {
    json["maps"].push_back({{"mapper", map.mapper},
                            {"nodes", map.nodes},
                            {"leaves", map.leaves},
                            {"median_scan_s", medianSeconds(map)},
                            {"mean_scan_s", meanSeconds(map)},
                            {"total_s", total(map.seconds)},
                            {"memory_usage_bytes", map.memory_usage},
                            {"resident_memory_bytes", orNull(map.resident_memory)},
                            {"scan_s", map.seconds}});
  }
  if (summary.identity) {
    json["compare"] = {{"speed_ratio", orNull(ratio(summary, meanSeconds))},
                       {"memory_ratio", orNull(ratio(summary, residentBytes))},
                       {"ot_identical", summary.identity->ot},
                       {"bt_identical", summary.identity->bt}};
  }
  json["files"] = toJson(summary.files);
  return json;
}

}  // namespace rhmap::tools
