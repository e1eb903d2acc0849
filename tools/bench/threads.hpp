// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "workload.hpp"

namespace rhmap::bench {

/// What several threads make of inserting scans. OctoMap knows one only.
struct ThreadsRow {
  double resolution = 0;  ///< [m]
  int threads = 0;
  std::vector<double> one, several;  ///< by the clock on the wall, one a scan and round [s]
  bool same_answers = true;          ///< the maps are equal
};

/// Inserts the scans by one thread and by several, turn and turn about, into a new pair of maps each round.
ThreadsRow compareThreads(std::span<const WorldScan> scans, double resolution, int threads, double max_range,
                          std::size_t rounds);

}  // namespace rhmap::bench
