// SPDX-License-Identifier: BSD-3-Clause
// What `rhmap compare` tells, to people and to programs.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "comparison.hpp"
#include "evaluation_table.hpp"
#include "statistics.hpp"
#include "text.hpp"

namespace rhmap::tools {
namespace {

/// A line of the table: a cell a mapper.
std::string row(const Comparison& comparison, const char* label, const std::function<std::string(std::size_t)>& cell) {
  std::string line = fmt::format("{:<24}", label);
  for (std::size_t k = 0; k < comparison.series.size(); ++k) line += fmt::format("{:>16}", cell(k));
  return line + "\n";
}

std::string verdict(const Comparison& comparison) {
  const auto word = [](bool same) { return same ? "identical" : "DIFFERENT"; };
  std::string text = fmt::format("bytes     rhmap and octomap: .ot {}, .bt {}\n", word(comparison.identity.ot),
                                 word(comparison.identity.bt));
  if (const auto& difference = comparison.difference)
    text += fmt::format("cells     of {} known ones {} differ in state, {} in value\n", grouped(difference->known),
                        grouped(difference->states), grouped(difference->values));
  return text;
}

}  // namespace

std::string toText(const Comparison& comparison) {
  const MappingConfig& mapping = comparison.options.mapping;
  std::string text = fmt::format("sequence  {}, scans {}-{}\n", comparison.options.sequence, comparison.frames.first,
                                 comparison.frames.last);
  text += fmt::format("settings  resolution {} m, range {} m to {}, {}\n", mapping.resolution, mapping.min_range,
                      mapping.max_range ? fmt::format("{} m", *mapping.max_range) : "any",
                      mapping.threads == 1 ? "1 thread" : fmt::format("{} threads", mapping.threads));
  text += fmt::format("points    {}, and {} dropped\n\n", grouped(comparison.points.inserted),
                      grouped(comparison.points.dropped));

  const auto& series = comparison.series;
  const auto milliseconds = [](double seconds) { return fmt::format("{:.2f} ms", 1e3 * seconds); };
  const auto of = [&](std::size_t k, auto figure) {
    return k < comparison.maps.size() ? figure(comparison.maps[k]) : std::string();
  };
  text += row(comparison, "", [&](std::size_t k) { return series[k].name; });
  text +=
      row(comparison, "time per scan, median", [&](std::size_t k) { return milliseconds(median(series[k].seconds)); });
  text += row(comparison, "time per scan, mean", [&](std::size_t k) { return milliseconds(mean(series[k].seconds)); });
  text += row(comparison, "time per scan, most", [&](std::size_t k) {
    return milliseconds(*std::max_element(series[k].seconds.begin(), series[k].seconds.end()));
  });
  text += row(comparison, "memory at the end", [&](std::size_t k) { return byteSize(series[k].memory.back()); });
  text += row(comparison, "resident memory", [&](std::size_t k) {
    return of(k, [](const MapFigures& map) {
      return map.resident_memory ? byteSize(*map.resident_memory) : std::string("unknown");
    });
  });
  text += row(comparison, "nodes",
              [&](std::size_t k) { return of(k, [](const MapFigures& map) { return grouped(map.nodes); }); });
  return text + "\n" + verdict(comparison) + toTable(comparison.scores);
}

nlohmann::ordered_json toJson(const Comparison& comparison) {
  const auto orNull = [](const auto& value) { return value ? nlohmann::ordered_json(*value) : nullptr; };
  const MappingConfig& mapping = comparison.options.mapping;
  nlohmann::ordered_json json{{"sequence", comparison.options.sequence},
                              {"first_scan", comparison.frames.first},
                              {"last_scan", comparison.frames.last},
                              {"resolution_m", mapping.resolution},
                              {"min_range_m", mapping.min_range},
                              {"max_range_m", orNull(mapping.max_range)},
                              {"threads", mapping.threads},
                              {"points", comparison.points.inserted},
                              {"dropped_points", comparison.points.dropped},
                              {"ot_identical", comparison.identity.ot},
                              {"bt_identical", comparison.identity.bt},
                              {"difference", nullptr}};
  if (const auto& difference = comparison.difference)
    json["difference"] = {{"known_cells", difference->known},
                          {"state_differs", difference->states},
                          {"value_differs", difference->values}};
  json["mappers"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < comparison.series.size(); ++k) {
    const MapperSeries& series = comparison.series[k];
    nlohmann::ordered_json mapper{{"mapper", series.name},
                                  {"median_scan_s", median(series.seconds)},
                                  {"mean_scan_s", mean(series.seconds)},
                                  {"memory_usage_bytes", series.memory.back()}};
    if (k < comparison.maps.size()) {
      mapper["nodes"] = comparison.maps[k].nodes;
      mapper["leaves"] = comparison.maps[k].leaves;
      mapper["resident_memory_bytes"] = orNull(comparison.maps[k].resident_memory);
    } else {
      mapper["removal"] = toJson(comparison.cleaned[k - comparison.maps.size()].figures);
    }
    mapper["scan_s"] = series.seconds;
    mapper["scan_memory_bytes"] = series.memory;
    json["mappers"].push_back(std::move(mapper));
  }
  json["scores"] = toJson(std::span<const eval::Score>(comparison.scores));
  return json;
}

std::string toCsv(const Comparison& comparison) {
  std::string text = "scan,mapper,seconds,memory_bytes\n";
  for (std::size_t i = 0; i <= comparison.frames.last - comparison.frames.first; ++i)
    for (const MapperSeries& series : comparison.series)
      text += fmt::format("{},{},{:.9f},{}\n", comparison.frames.first + i, series.name, series.seconds[i],
                          series.memory[i]);
  return text;
}

}  // namespace rhmap::tools
