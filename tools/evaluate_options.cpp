// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate_options.hpp"

#include <algorithm>
#include <string_view>

namespace rhmap::tools {

eval::EvaluationConfig evaluationConfig(const EvaluateOptions& options, const FrameRange& frames) {
  const auto asksFor = [&](std::string_view protocol) {
    return options.protocols.empty() ||
           std::find(options.protocols.begin(), options.protocols.end(), protocol) != options.protocols.end();
  };
  eval::EvaluationConfig config{.window = {.first = frames.first,
                                           .last = frames.last,
                                           .min_range = options.removal.min_range,
                                           .max_range = options.removal.max_range},
                                .labels = eval::Labels()};
  config.rhmap->resolution = options.removal.resolution;
  config.kth->ego_radius = options.ego_radius;
  if (!asksFor("rhmap")) config.rhmap.reset();
  if (!asksFor("erasor")) config.erasor.reset();
  if (!asksFor("kth")) config.kth.reset();
  return config;
}

void requireLabels(const std::string& path, const io::ScanSequence& sequence) {
  if (!sequence.hasLabels()) throw std::runtime_error(path + ": has no labels (labels/NNNNNN.label) to score against");
}

}  // namespace rhmap::tools
