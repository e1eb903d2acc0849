// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "written_file.hpp"

namespace rhmap::tools {

/// What `rhmap build` is asked for.
struct BuildOptions {
  std::string sequence;
  std::vector<std::string> maps;    ///< files to write, .bt or .ot
  double resolution = 0.1;          ///< edge of the smallest cube [m]
  std::optional<double> max_range;  ///< where rays are cut [m]
  double min_range = 0;             ///< nearer points are dropped [m]
  std::string mapper = "rhmap";
  std::string frames;  ///< "A-B"; empty: all
  int threads = 1;
  bool compare = false;
  std::string json;  ///< file of the summary, "-" is stdout; empty: none
};

/// One mapper on all scans.
struct MapFigures {
  std::string mapper;
  std::vector<double> seconds;  ///< per scan, insertion only
  std::size_t nodes = 0;
  std::size_t leaves = 0;
  std::size_t memory_usage = 0;                ///< what the tree says of itself [bytes]
  std::optional<std::size_t> resident_memory;  ///< physical memory that its end gives back [bytes]
};

/// Whether two mappers wrote the same bytes.
struct Identity {
  bool ot = false;
  bool bt = false;
};

/// What `rhmap build` tells.
struct BuildSummary {
  BuildOptions options;
  FrameRange frames;
  std::size_t points = 0;   ///< inserted
  std::size_t dropped = 0;  ///< not finite, or nearer than the minimum range
  std::vector<MapFigures> maps;
  std::optional<Identity> identity;
  std::vector<WrittenFile> files;
};

/// For people: aligned lines, one column a mapper.
std::string toText(const BuildSummary& summary);

/// For programs: SI units, ratios as OctoMap's figure over rhmap's.
nlohmann::ordered_json toJson(const BuildSummary& summary);

}  // namespace rhmap::tools
