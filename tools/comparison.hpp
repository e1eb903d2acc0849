// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "map_difference.hpp"
#include "mapping.hpp"
#include "removal_run.hpp"
#include "rhmap/core/key_set.hpp"
#include "rhmap/eval/evaluate.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap::tools {

/// What is compared, on which scans.
struct ComparisonOptions {
  std::string sequence;
  MappingConfig mapping{.max_range = {}, .min_range = RemovalConfig{}.min_range};
  std::string frames;                 ///< "A-B"; empty: all
  std::vector<std::string> profiles;  ///< of the removal; empty: maps of everything only
};

/// One mapper, scan by scan.
struct MapperSeries {
  std::string name;
  std::vector<double> seconds;      ///< of a scan: wall clock, with removal processor time
  std::vector<std::size_t> memory;  ///< what it says that it holds after the scan [bytes]
};

/// A map that was kept clean.
struct CleanedMap {
  std::string profile;
  std::unique_ptr<OcTree> map;
  RemovalFigures figures;
};

/// rhmap and OctoMap on the same scans.
struct Comparison {
  ComparisonOptions options;
  FrameRange frames;
  PointCounts points;
  std::vector<MapFigures> maps;             ///< rhmap, octomap
  std::vector<MapperSeries> series;         ///< the same, then one a profile
  Identity identity;                        ///< of what rhmap and OctoMap write
  std::optional<MapDifference> difference;  ///< counted where the bytes are not the same
  std::unique_ptr<OcTree> octomap;          ///< OctoMap's map, read from what it writes; null if nothing
                                            ///< asks for it: the bytes are the same, and no profile is compared
  std::vector<CleanedMap> cleaned;
  KeySet hits;                      ///< cells that any scan has hit, in the ranges of the removal
  KeySet ground;                    ///< cells that the removal took for ground when they were hit
  std::vector<eval::Score> scores;  ///< with labels and a profile: baselines, OctoMap's rows, the profiles
};

/// Runs it all, with bars of progress; `protocols` are those of the scores, window and labels aside.
Comparison compareMappers(const ComparisonOptions& options, const eval::EvaluationConfig& protocols);

/// Of the sequence that was compared, in the ranges that were.
eval::SequenceWindow windowOf(const Comparison& comparison);

/// For people: a column a mapper, what the bytes say, a table of the scores.
std::string toText(const Comparison& comparison);

/// For programs: SI units.
nlohmann::ordered_json toJson(const Comparison& comparison);

/// A line a scan and mapper: scan,mapper,seconds,memory_bytes.
std::string toCsv(const Comparison& comparison);

}  // namespace rhmap::tools
