// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "rhmap/removal/rh_map.hpp"

namespace rhmap::tools {

/// How often RemovalFigures::bytes is asked for: it takes a millisecond.
inline constexpr std::size_t kScansBetweenBytes = 50;

/// What the removal did to a part of a sequence, and how long that took.
struct RemovalFigures {
  std::size_t scans = 0;
  std::size_t points = 0;                                  ///< that were used
  std::size_t dropped = 0;                                 ///< not finite, or outside of the ranges or of the map
  std::size_t inserted = 0;                                ///< cubes, each once a scan that hits it
  std::size_t rejected = 0;                                ///< cubes that were hit and kept out
  std::size_t removed = 0;                                 ///< cubes that were taken out again
  std::size_t keyframes = 0;                               ///< of the back end
  std::vector<double> seconds;                             ///< processor time of each scan [s]
  std::array<std::vector<double>, kStages> stage_seconds;  ///< the same, stage by stage
  std::vector<std::size_t> bytes;  ///< what the removal keeps beside the map, every kScansBetweenBytes scans
  double finish_seconds = 0;       ///< processor time of what was left to do after the last scan [s]

  void add(const ScanReport& report);

  /// All processor time over all scans, with what is left for the end [s].
  double meanSeconds() const;
};

/// Called when a scan is in the map, outside of what is measured.
using AfterScan = std::function<void(const io::Scan& scan, const RhMap& map)>;

/// Inserts the frames of a sequence into an empty map and finishes it. `label` is for the progress bar.
RemovalFigures runRemoval(const io::ScanSequence& sequence, const FrameRange& frames, RhMap& map,
                          const std::string& label, const AfterScan& after_scan = {});

/// For programs: counts, and times in seconds.
nlohmann::ordered_json toJson(const RemovalFigures& figures);

}  // namespace rhmap::tools
