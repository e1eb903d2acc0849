// SPDX-License-Identifier: BSD-3-Clause
#include "report_page.hpp"

#include <fmt/format.h>

#include <array>

#include "embedded.hpp"
#include "html.hpp"
#include "report_cells.hpp"
#include "report_plot.hpp"
#include "report_tables.hpp"
#include "statistics.hpp"
#include "text.hpp"

namespace rhmap::tools {
namespace {

constexpr std::array<const char*, 4> kLineColours{"#2f6db5", "#e08a1e", "#2e9e6b", "#8a5cc2"};

std::string card(const std::string& figure, const std::string& what) {
  return fmt::format("<div class=\"card\"><b>{}</b><span>{}</span></div>\n", escapeHtml(figure), escapeHtml(what));
}

/// What is worth knowing first.
std::string cards(const Comparison& comparison) {
  const MapFigures &ours = comparison.maps[0], &theirs = comparison.maps[1];
  std::string text = card(comparison.identity.ot && comparison.identity.bt ? "identical" : "different",
                          "bytes of rhmap's and OctoMap's map (.ot, .bt)");
  if (const double seconds = median(ours.seconds); seconds > 0)
    text += card(fmt::format("{:.1f} x", median(theirs.seconds) / seconds),
                 fmt::format("faster than OctoMap: {:.1f} ms a scan, not {:.1f} ms", 1e3 * seconds,
                             1e3 * median(theirs.seconds)));
  if (ours.resident_memory && theirs.resident_memory && *ours.resident_memory > 0)
    text += card(fmt::format("1/{:.0f}", double(*theirs.resident_memory) / double(*ours.resident_memory)),
                 fmt::format("of OctoMap's memory: {}, not {}", byteSize(*ours.resident_memory),
                             byteSize(*theirs.resident_memory)));
  const CleanedMap& cleaned = comparison.cleaned.front();
  text += card(fmt::format("{:.1f} ms", 1e3 * median(cleaned.figures.seconds)),
               "a scan with what moves kept out, profile " + cleaned.profile);
  for (const eval::Score& score : comparison.scores) {
    if (score.protocol != "rhmap" || score.row != "rhmap " + cleaned.profile || !score.cells) continue;
    const auto percent = [](std::optional<double> rate) { return rate ? fmt::format("{:.1f} %", 100 * *rate) : "-"; };
    text += card(percent(score.cells->dynamicRemoved()), "of the moving cells are gone (RR)");
    text += card(percent(score.cells->staticKept()), "of the static cells are kept (PR)");
  }
  return text;
}

std::string figures(std::span<const ReportPicture> pictures) {
  std::string text;
  for (const ReportPicture& picture : pictures)
    text +=
        fmt::format("<figure><img src=\"data:image/png;base64,{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                    base64(picture.png), escapeHtml(picture.caption), escapeHtml(picture.caption));
  return text;
}

std::string plots(const Comparison& comparison) {
  Plot time{
      .title = "Time of a scan", .unit = "ms", .logarithmic = true, .first_scan = comparison.frames.first, .lines = {}};
  Plot memory{.title = "Memory of the map", .unit = "MB", .first_scan = comparison.frames.first, .lines = {}};
  for (std::size_t k = 0; k < comparison.series.size(); ++k) {
    const MapperSeries& series = comparison.series[k];
    const char* colour = kLineColours[k % kLineColours.size()];
    PlotLine ms{series.name, colour, {}}, megabytes{series.name, colour, {}};
    for (const double seconds : series.seconds) ms.values.push_back(1e3 * std::max(seconds, 1e-6));
    for (const std::size_t bytes : series.memory) megabytes.values.push_back(1e-6 * double(bytes));
    time.lines.push_back(std::move(ms));
    memory.lines.push_back(std::move(megabytes));
  }
  return toSvg(time) + toSvg(memory);
}

std::string viewerScripts(const Comparison& comparison, const ReportMaps& maps) {
  const std::array<NamedMap, 3> named{NamedMap{"without removal", maps.everything}, NamedMap{"OctoMap", maps.octomap},
                                      NamedMap{"rhmap " + comparison.cleaned.front().profile, maps.cleaned}};
  std::string text = "<script type=\"application/json\" id=\"maps\">" + cellsJson(named, maps.moving) + "</script>\n";
  text.append("<script type=\"text/plain\" id=\"three-licence\">\n")
      .append(embedded::three_licence())
      .append("</script>\n");
  for (const std::string_view script : {embedded::three(), embedded::orbit_controls(), embedded::viewer_script()})
    text.append("<script>\n").append(script).append("\n</script>\n");
  return text;
}

}  // namespace

std::string missingViewer() {
  if (!embedded::three().empty() && !embedded::orbit_controls().empty()) return {};
  return "the page has no 3D view: three.js was not there when this program was built; install libjs-three, then "
         "configure and build it again";
}

std::string reportPage(const Comparison& comparison, const ReportMaps& maps, std::span<const ReportPicture> pictures) {
  const std::string missing = missingViewer();
  const std::string red = "Red is what is left of what moved, by the labels of the sequence.";
  return fillIn(
      embedded::page(),
      {{"sequence", escapeHtml(comparison.options.sequence)},
       {"first", std::to_string(comparison.frames.first)},
       {"last", std::to_string(comparison.frames.last)},
       {"points", grouped(comparison.points.inserted)},
       {"resolution", fmt::format("{}", comparison.options.mapping.resolution)},
       {"style", std::string(embedded::style())},
       {"cards", cards(comparison)},
       {"pictures_text", maps.has_labels ? red : "The sequence has no labels that say what moved."},
       {"pictures", figures(pictures)},
       {"viewer",
        missing.empty() ? std::string(embedded::viewer()) : "<p class=\"hint\">" + escapeHtml(missing) + "</p>"},
       {"scores", scoreTables(comparison)},
       {"measurements", measurementTable(comparison)},
       {"plots", plots(comparison)},
       {"settings", settingsTable(comparison)},
       {"commands", escapeHtml(commandsOf(comparison))},
       {"version", RHMAP_VERSION},
       {"credits", missing.empty()
                       ? "; 3D view by three.js, under the MIT licence, whose text is in the source of this page"
                       : ""},
       {"scripts", missing.empty() ? viewerScripts(comparison, maps) : ""}});
}

}  // namespace rhmap::tools
