// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "removal_run.hpp"
#include "rhmap/eval/estimate.hpp"
#include "rhmap/eval/evaluate.hpp"
#include "rhmap/eval/score.hpp"
#include "rhmap/octree/octree.hpp"
#include "rhmap/removal/removal_config.hpp"

namespace rhmap::tools {

/// A row of the scores that a run of the mapper makes.
struct MapperRow {
  std::string name;
  RemovalConfig config;
};

/// Scans from a scan's insertion to the second judgement of its points: a second of a LiDAR at 10 Hz.
inline constexpr std::size_t kOnlineLag = 10;

/// What a run left.
struct MapperRun {
  std::string name;
  std::unique_ptr<OcTree> map;  ///< without the memory of the removal
  RemovalFigures figures;
  eval::Counts at_insertion;  ///< each scan's points right after its insertion
  eval::Counts later;         ///< and kOnlineLag scans later
};

/// Runs and their scores, beside those of the baselines.
struct Evaluation {
  std::vector<MapperRun> runs;
  std::vector<eval::Score> scores;  ///< protocol by protocol: no removal, oracle, the runs, `elsewhere`
};

/// Runs the mapper for each row, one after the other, over the window of a labelled sequence and scores the final maps;
/// `elsewhere` are rows that were made by others. `label` is for the progress bars.
Evaluation evaluateRows(const io::ScanSequence& sequence, const eval::EvaluationConfig& config, double resolution,
                        std::span<const MapperRow> rows, std::span<const eval::Estimate> elsewhere,
                        const std::string& label);

/// The scores while the maps grew, two rows a run, as protocol "online".
std::vector<eval::Score> onlineScores(std::span<const MapperRun> runs);

/// Processor time of a scan, whole and by stages, a row a run.
std::string timeTable(std::span<const MapperRun> runs);

/// An array of names and figures.
nlohmann::ordered_json toJson(std::span<const MapperRun> runs);

}  // namespace rhmap::tools
