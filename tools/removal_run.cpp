// SPDX-License-Identifier: BSD-3-Clause
#include "removal_run.hpp"

#include <nlohmann/json.hpp>

#include "progress_bar.hpp"
#include "statistics.hpp"

namespace rhmap::tools {

void RemovalFigures::add(const ScanReport& report) {
  ++scans;
  points += report.points - report.dropped;
  dropped += report.dropped;
  inserted += report.inserted;
  rejected += report.rejected;
  removed += report.removed;
  keyframes += report.keyframe ? 1 : 0;
  seconds.push_back(report.totalSeconds());
  for (std::size_t s = 0; s < kStages; ++s) stage_seconds[s].push_back(report.seconds[s]);
}

double RemovalFigures::meanSeconds() const {
  return scans == 0 ? 0 : (total(seconds) + finish_seconds) / static_cast<double>(scans);
}

RemovalFigures runRemoval(const io::ScanSequence& sequence, const FrameRange& frames, RhMap& map,
                          const std::string& label, const AfterScan& after_scan) {
  RemovalFigures figures;
  ProgressBar bar(label, frames.last - frames.first + 1);
  for (std::size_t i = frames.first; i <= frames.last; ++i) {
    const io::Scan scan = sequence.scan(i);
    figures.add(map.insertScan(scan.points, scan.pose));
    figures.dropped += scan.dropped;
    if (figures.scans % kScansBetweenBytes == 0) figures.bytes.push_back(map.removalMemoryUsage());
    if (after_scan) after_scan(scan, map);
    bar.advance();
  }
  const ScanReport rest = map.finish();
  figures.removed += rest.removed;
  figures.finish_seconds = rest.totalSeconds();
  return figures;
}

nlohmann::ordered_json toJson(const RemovalFigures& figures) {
  nlohmann::ordered_json json{{"scans", figures.scans},
                              {"points", figures.points},
                              {"dropped_points", figures.dropped},
                              {"inserted_cubes", figures.inserted},
                              {"rejected_cubes", figures.rejected},
                              {"removed_cubes", figures.removed},
                              {"keyframes", figures.keyframes},
                              {"median_scan_s", median(figures.seconds)},
                              {"mean_scan_s", figures.meanSeconds()}};
  json["median_stage_s"] = nlohmann::ordered_json::object();
  for (std::size_t s = 0; s < kStages; ++s)
    json["median_stage_s"][std::string(nameOf(static_cast<Stage>(s)))] = median(figures.stage_seconds[s]);
  json["finish_s"] = figures.finish_seconds;
  json["scan_s"] = figures.seconds;
  json["removal_bytes_each_50_scans"] = figures.bytes;
  return json;
}

}  // namespace rhmap::tools
