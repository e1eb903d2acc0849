// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "workload.hpp"

namespace rhmap::bench {

/// What several threads make of inserting scans. OctoMap knows one only. Times by the clock on the wall, one a scan and
/// round [s].
struct ThreadsRow {
  double resolution = 0;  ///< [m]
  int threads = 0;
  std::vector<double> one, several;
  /// A scan's share of the time in which as many threads insert it at once, each into a map of its own: what these
  /// processors can give, which need not be equally fast.
  std::vector<double> apart;
  bool same_answers = true;  ///< the maps are equal
};

/// Inserts the scans by one thread, by several, and by several apart, turn and turn about, into new maps each round.
ThreadsRow compareThreads(std::span<const WorldScan> scans, double resolution, int threads, double max_range,
                          std::size_t rounds);

}  // namespace rhmap::bench
