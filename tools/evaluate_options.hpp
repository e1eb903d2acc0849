// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "arguments.hpp"
#include "removal_options.hpp"
#include "rhmap/eval/evaluate.hpp"
#include "rhmap/io/scan_sequence.hpp"

namespace rhmap::tools {

/// What `rhmap evaluate` is asked for.
struct EvaluateOptions {
  std::string sequence;               ///< a sequence; with `tables` the folder of SemanticKITTI
  std::vector<std::string> profiles;  ///< of the mapper's rows; empty: what the verb says
  std::string map;                    ///< cleaned map or cloud; empty: none
  bool ablation = false;              ///< the mapper's rows are those of ablationRows()
  bool octomap = false;               ///< OctoMap's rows as well
  bool tables = false;                ///< the paper's tables
  std::vector<std::string> windows;   ///< of the tables, "SEQUENCE:A-B"; empty: the paper's
  RemovalOptions removal;
  double ego_radius = eval::KthConfig{}.ego_radius;
  std::vector<std::string> protocols;  ///< empty: what the verb says
  std::string json;
};

/// What is scored and how, over these scans.
eval::EvaluationConfig evaluationConfig(const EvaluateOptions& options, const FrameRange& frames);

/// Throws std::runtime_error where there is nothing to score against.
void requireLabels(const std::string& path, const io::ScanSequence& sequence);

}  // namespace rhmap::tools
