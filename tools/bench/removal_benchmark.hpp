// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "rhmap/io/scan_sequence.hpp"
#include "rhmap/removal/rh_map.hpp"

namespace rhmap::bench {

struct RemovalBenchConfig {
  std::vector<std::string> profiles{"fast", "default"};
  double resolution = 0.1;            ///< edge of a cube [m]
  std::size_t rounds = 3;             ///< times that each profile maps the sequence
  std::optional<std::size_t> scans;   ///< the first of the sequence; all unless told
  std::optional<std::size_t> window;  ///< scans in a row that are looked at by themselves; none unless told
};

/// Memory after a scan [bytes].
struct MemorySample {
  std::size_t removal = 0;   ///< what the removal keeps beside the tree
  std::size_t tree = 0;      ///< the tree itself
  std::size_t resident = 0;  ///< the whole process, with the scan and the bench's figures
};

/// Some scans in a row: medians over them.
struct Window {
  std::size_t first = 0, last = 0;             ///< scans, both included
  double way = 0;                              ///< of the sensor, from scan 0 to the last [m]
  double points = 0;                           ///< of a scan
  double seconds = 0;                          ///< processor time of a scan [s]
  std::array<double, kStages> stages{};        ///< the same of each stage [s]
  double removal = 0, tree = 0, resident = 0;  ///< memory as in MemorySample
};

/// What one profile took over a sequence.
struct RemovalRow {
  std::string profile;
  std::array<std::vector<double>, kStages> stages;  ///< processor time of each scan, the median of the rounds [s]
  std::vector<double> totals;                       ///< the same of all stages together
  double finish = 0;        ///< processor time of what is left for the end, median of the rounds [s]
  std::size_t removed = 0;  ///< cubes taken out, in one round
  std::vector<Window> windows;
};

/// Maps the sequence with each profile in turn, round by round, in this thread.
std::vector<RemovalRow> benchmarkRemoval(const io::ScanSequence& sequence, const RemovalBenchConfig& config);

}  // namespace rhmap::bench
