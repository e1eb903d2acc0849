// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "mapping.hpp"
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

/// What `rhmap build` tells.
struct BuildSummary {
  BuildOptions options;
  FrameRange frames;
  PointCounts points;
  std::vector<MapFigures> maps;
  std::optional<Identity> identity;
  std::vector<WrittenFile> files;
};

/// For people: aligned lines, one column a mapper.
std::string toText(const BuildSummary& summary);

/// For programs: SI units, ratios as OctoMap's figure over rhmap's.
nlohmann::ordered_json toJson(const BuildSummary& summary);

}  // namespace rhmap::tools
