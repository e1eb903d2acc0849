// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_table.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "text.hpp"

namespace rhmap::tools {
namespace {

using eval::Counts;
using eval::Score;
using eval::Survivors;

std::string percent(std::optional<double> rate) { return rate ? fmt::format("{:.2f}", 100 * *rate) : "-"; }
std::string fraction(std::optional<double> rate) { return rate ? fmt::format("{:.4f}", *rate) : "-"; }

std::string keptOf(const Survivors& survivors) { return grouped(survivors.kept) + " / " + grouped(survivors.total); }

constexpr std::size_t kNameWidth = 14;

/// One table of cells or of points, whichever `part` chooses.
struct Table {
  std::optional<Counts> Score::*part;
  const char* unit;
  const char* rates[3];  // what the static, dynamic and joint rate are called
  bool points;
};

constexpr Table kCells{&Score::cells, "cells", {"PR", "RR", "F1"}, false};
constexpr Table kPoints{&Score::points, "points", {"SA", "DA", "AA"}, true};

std::string toText(const Table& table, std::span<const Score> scores) {
  std::set<std::uint16_t> classes;
  for (const Score& score : scores) {
    for (const auto& [label, survivors] : (score.*table.part)->classes) classes.insert(label);
  }
  const std::string unit = table.unit;
  std::string text =
      fmt::format("{:<{}}{:>8}{:>8}{:>8}{:>8}{:>26}{:>22}", "", kNameWidth, table.rates[0], table.rates[1],
                  table.rates[2], table.points ? "HA" : "", "static " + unit + " kept", "dynamic kept");
  for (const std::uint16_t label : classes) text += fmt::format("{:>8}", fmt::format("{} {}", table.rates[1], label));
  text += "\n";
  for (const Score& score : scores) {
    const Counts& counts = *(score.*table.part);
    text +=
        fmt::format("{:<{}}{:>8}{:>8}{:>8}{:>8}{:>26}{:>22}", score.row, kNameWidth, percent(counts.staticKept()),
                    percent(counts.dynamicRemoved()),
                    table.points ? percent(counts.geometricMean()) : fraction(counts.harmonicMean()),
                    table.points ? percent(counts.harmonicMean()) : "", keptOf(counts.still), keptOf(counts.moving));
    for (const std::uint16_t label : classes) {
      const auto found = counts.classes.find(label);
      text += fmt::format("{:>8}", found == counts.classes.end() ? "-" : percent(eval::removed(found->second)));
    }
    text += "\n";
  }
  return text;
}

nlohmann::ordered_json orNull(std::optional<double> rate) {
  return rate ? nlohmann::ordered_json(*rate) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json toJson(const Table& table, const Counts& counts) {
  nlohmann::ordered_json json{{"static", counts.still.total},
                              {"static_kept", counts.still.kept},
                              {"dynamic", counts.moving.total},
                              {"dynamic_kept", counts.moving.kept},
                              {table.rates[0], orNull(counts.staticKept())},
                              {table.rates[1], orNull(counts.dynamicRemoved())}};
  if (table.points) json["AA"] = orNull(counts.geometricMean());
  json[table.points ? "HA" : "F1"] = orNull(counts.harmonicMean());
  json["classes"] = nlohmann::ordered_json::array();
  for (const auto& [label, survivors] : counts.classes)
    json["classes"].push_back({{"class", label},
                               {"dynamic", survivors.total},
                               {"dynamic_kept", survivors.kept},
                               {table.rates[1], orNull(eval::removed(survivors))}});
  return json;
}

}  // namespace

std::string toTable(std::span<const Score> scores) {
  std::string text;
  for (std::size_t begin = 0; begin < scores.size();) {
    std::size_t end = begin;
    while (end < scores.size() && scores[end].protocol == scores[begin].protocol) ++end;
    const auto part = scores.subspan(begin, end - begin);
    text += fmt::format("\nprotocol {}\n", part.front().protocol);
    if (part.front().cells) text += toText(kCells, part);
    if (part.front().points) text += toText(kPoints, part);
    begin = end;
  }
  return text;
}

nlohmann::ordered_json toJson(std::span<const Score> scores) {
  auto rows = nlohmann::ordered_json::array();
  for (const Score& score : scores) {
    nlohmann::ordered_json row{{"protocol", score.protocol}, {"row", score.row}};
    if (score.cells) {
      row["cells"] = toJson(kCells, *score.cells);
      row["cells"]["estimate_static"] = score.static_cells;
      row["cells"]["estimate_dynamic"] = score.dynamic_cells;
    }
    if (score.points) row["points"] = toJson(kPoints, *score.points);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace rhmap::tools
