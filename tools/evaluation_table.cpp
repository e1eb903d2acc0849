// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <vector>

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

/// SemanticKITTI's moving classes; 251 is our clip's, and stands apart.
constexpr std::uint16_t kFirstMoving = 252, kLastMoving = 259;

/// A column of the dynamic ones of some classes.
struct ClassColumn {
  std::uint16_t first;
  std::uint16_t last;
};

std::string nameOf(const ClassColumn& column) {
  return column.first == column.last ? fmt::format("{}", column.first)
                                     : fmt::format("{}-{}", column.first, column.last);
}

/// A column a class that occurs, and one for all but 251 where that would be news.
std::vector<ClassColumn> columnsOf(const std::set<std::uint16_t>& classes) {
  std::vector<ClassColumn> columns;
  const auto first = classes.lower_bound(kFirstMoving);
  if (first != classes.begin() && std::distance(first, classes.end()) > 1)
    columns.push_back({*first, *classes.rbegin()});
  for (const std::uint16_t label : classes) columns.push_back({label, label});
  return columns;
}

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
  const auto columns = columnsOf(classes);
  std::size_t width = kNameWidth;
  for (const Score& score : scores) width = std::max(width, score.row.size());
  const std::string unit = table.unit;
  std::string text = fmt::format("{:<{}}{:>8}{:>8}{:>8}{:>8}{:>26}{:>22}", "", width, table.rates[0], table.rates[1],
                                 table.rates[2], table.points ? "HA" : "", "static " + unit + " kept", "dynamic kept");
  for (const ClassColumn& column : columns)
    text += fmt::format("  {:>6}", fmt::format("{} {}", table.rates[1], nameOf(column)));
  text += "\n";
  for (const Score& score : scores) {
    const Counts& counts = *(score.*table.part);
    text +=
        fmt::format("{:<{}}{:>8}{:>8}{:>8}{:>8}{:>26}{:>22}", score.row, width, percent(counts.staticKept()),
                    percent(counts.dynamicRemoved()),
                    table.points ? percent(counts.geometricMean()) : fraction(counts.harmonicMean()),
                    table.points ? percent(counts.harmonicMean()) : "", keptOf(counts.still), keptOf(counts.moving));
    for (const ClassColumn& column : columns)
      text += fmt::format("  {:>{}}", percent(eval::removed(counts.movingOf(column.first, column.last))),
                          std::max<std::size_t>(6, 3 + nameOf(column).size()));
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
  const auto figures = [&table](const char* key, const nlohmann::ordered_json& value, const Survivors& survivors) {
    return nlohmann::ordered_json{{key, value},
                                  {"dynamic", survivors.total},
                                  {"dynamic_kept", survivors.kept},
                                  {table.rates[1], orNull(eval::removed(survivors))}};
  };
  json["groups"] = {
      figures("classes", "251", counts.movingOf(251, 251)),
      figures("classes", nameOf({kFirstMoving, kLastMoving}), counts.movingOf(kFirstMoving, kLastMoving))};
  json["classes"] = nlohmann::ordered_json::array();
  for (const auto& [label, survivors] : counts.classes) json["classes"].push_back(figures("class", label, survivors));
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
