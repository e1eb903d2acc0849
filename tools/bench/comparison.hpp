// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "../statistics.hpp"
#include "library.hpp"

namespace rhmap::bench {

struct ComparisonConfig {
  double max_range = 50;          ///< of the scans' rays [m]
  std::size_t variant_scans = 3;  ///< scans of each scan benchmark but the first, which gets all
  std::size_t rounds = 3;         ///< runs of every map benchmark
  std::string only;               ///< run the benchmarks with this in their name; the map is built for any of them

  bool wants(std::string_view name) const { return name.find(only) != std::string_view::npos; }
};

/// A benchmark's measurements: one a scan or one a round, time per operation [s].
struct Row {
  double resolution = 0;  ///< [m]
  Title title;
  std::size_t operations = 0;  ///< of the last measurement
  std::vector<double> octomap{}, rhmap{};
  bool same_answers = true;
};

/// A map's physical memory [bytes].
struct MemoryRow {
  std::string map;
  std::size_t nodes = 0;
  std::size_t octomap = 0, rhmap = 0;
  bool same_answers = true;
};

using tools::median;

/// How many times OctoMap's median is rhmap's.
inline double ratio(const Row& row) { return median(row.octomap) / median(row.rhmap); }

/// Runs both libraries at one resolution, turn and turn about; calls back with every row as it is done.
void compare(std::span<const WorldScan> scans, double resolution, const ComparisonConfig& config,
             const std::function<void(const Row&)>& done, const std::function<void(const MemoryRow&)>& memory_done);

/// The physical memory of a .bt file's map in both libraries.
MemoryRow compareMemory(const std::filesystem::path& bt_file);

}  // namespace rhmap::bench
