// SPDX-License-Identifier: BSD-3-Clause
#include "report_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "html.hpp"
#include "statistics.hpp"
#include "text.hpp"

namespace rhmap::tools {
namespace {

using Cells = std::vector<std::string>;

std::string tableRow(const Cells& cells, const char* element, bool ours = false) {
  std::string text = ours ? "<tr class=\"ours\">" : "<tr>";
  for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", element, escapeHtml(cell));
  return text + "</tr>\n";
}

std::string table(const Cells& head, const std::vector<Cells>& rows, const auto& is_ours) {
  std::string text = "<div class=\"wide\"><table>\n" + tableRow(head, "th");
  for (const Cells& row : rows) text += tableRow(row, "td", is_ours(row));
  return text + "</table></div>\n";
}

std::string percent(std::optional<double> rate) { return rate ? fmt::format("{:.2f}", 100 * *rate) : "-"; }

std::string keptOf(const eval::Survivors& survivors) {
  return grouped(survivors.kept) + " / " + grouped(survivors.total);
}

/// The rows of one protocol, by cells or by points.
std::string scoreTable(const Comparison& comparison, const std::string& protocol,
                       std::optional<eval::Counts> eval::Score::*part) {
  const bool cells = part == &eval::Score::cells;
  std::vector<Cells> rows;
  for (const eval::Score& score : comparison.scores) {
    if (score.protocol != protocol || !(score.*part)) continue;
    const eval::Counts& counts = *(score.*part);
    Cells row{score.row, percent(counts.staticKept()), percent(counts.dynamicRemoved())};
    if (!cells) row.push_back(percent(counts.geometricMean()));
    const auto joint = counts.harmonicMean();
    row.push_back(cells ? (joint ? fmt::format("{:.4f}", *joint) : "-") : percent(joint));
    row.push_back(keptOf(counts.still));
    row.push_back(keptOf(counts.moving));
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return {};
  const Cells head = cells ? Cells{"cells", "PR %", "RR %", "F1", "static kept", "moving kept"}
                           : Cells{"points", "SA %", "DA %", "AA %", "HA %", "static kept", "moving kept"};
  return table(head, rows, [](const Cells& row) { return row[0].starts_with("rhmap "); });
}

/// As a shell reads it back.
std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) || std::string_view("/._-+,:").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

std::string scoreTables(const Comparison& comparison) {
  if (comparison.scores.empty()) return "<p>The sequence has no labels to score against.</p>\n";
  std::vector<std::string> protocols;
  for (const eval::Score& score : comparison.scores)
    if (std::find(protocols.begin(), protocols.end(), score.protocol) == protocols.end())
      protocols.push_back(score.protocol);
  std::string text =
      "<p>PR, SA: how much of the static world is kept. RR, DA: how much of what moved is gone. Numbers of different "
      "protocols do not belong in one comparison; doc/evaluation.md says what they are.</p>\n";
  for (const std::string& protocol : protocols)
    text += fmt::format("<h3>Protocol {}</h3>\n", escapeHtml(protocol)) +
            scoreTable(comparison, protocol, &eval::Score::cells) +
            scoreTable(comparison, protocol, &eval::Score::points);
  return text;
}

std::string measurementTable(const Comparison& comparison) {
  const auto milliseconds = [](double seconds) { return fmt::format("{:.2f}", 1e3 * seconds); };
  std::vector<Cells> rows;
  for (std::size_t k = 0; k < comparison.series.size(); ++k) {
    const MapperSeries& series = comparison.series[k];
    std::string resident = "-";
    if (k < comparison.maps.size() && comparison.maps[k].resident_memory)
      resident = byteSize(*comparison.maps[k].resident_memory);
    rows.push_back({series.name, milliseconds(median(series.seconds)), milliseconds(mean(series.seconds)),
                    milliseconds(*std::max_element(series.seconds.begin(), series.seconds.end())),
                    byteSize(series.memory.back()), resident});
  }
  return table({"mapper", "median [ms]", "mean [ms]", "most [ms]", "memory, by itself", "resident memory"}, rows,
               [](const Cells& row) { return row[0] != "octomap"; });
}

std::string settingsTable(const Comparison& comparison) {
  const MappingConfig& mapping = comparison.options.mapping;
  const std::vector<Cells> rows{
      {"sequence", comparison.options.sequence},
      {"scans", fmt::format("{} to {}", comparison.frames.first, comparison.frames.last)},
      {"points inserted", grouped(comparison.points.inserted)},
      {"points dropped", grouped(comparison.points.dropped)},
      {"edge of a cell", fmt::format("{} m", mapping.resolution)},
      {"points are dropped below", fmt::format("{} m", mapping.min_range)},
      {"rays are cut at", mapping.max_range ? fmt::format("{} m", *mapping.max_range) : "no range"},
      {"threads", std::to_string(mapping.threads)},
      {"profile of the removal", comparison.cleaned.front().profile},
      {"rhmap", RHMAP_VERSION}};
  return table({"setting", "value"}, rows, [](const Cells&) { return false; });
}

std::string commandsOf(const Comparison& comparison) {
  const MappingConfig& mapping = comparison.options.mapping;
  const std::string sequence = quoted(comparison.options.sequence);
  const std::string profile = comparison.cleaned.front().profile;
  std::string common = fmt::format(" --frames {}-{} --resolution {} --min-range {}", comparison.frames.first,
                                   comparison.frames.last, mapping.resolution, mapping.min_range);
  if (mapping.max_range) common += fmt::format(" --max-range {}", *mapping.max_range);
  const std::string threads = mapping.threads == 1 ? "" : fmt::format(" --threads {}", mapping.threads);
  std::string text = fmt::format("rhmap report {} -o report{}{} --profile {}\n", sequence, common, threads, profile);
  text += fmt::format("rhmap compare {}{}{} --profile {}\n", sequence, common, threads, profile);
  text += fmt::format("rhmap clean {} clean.bt{} --profile {}\n", sequence, common, profile);
  if (!comparison.scores.empty())
    text += fmt::format("rhmap evaluate {}{} --profile {} --octomap\n", sequence, common, profile);
  return text;
}

}  // namespace rhmap::tools
