// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "rhmap/eval/protocol.hpp"

namespace rhmap::eval {

/// What is evaluated, and by which protocols: those that have a config.
struct EvaluationConfig {
  SequenceWindow window;
  Labels labels;
  std::optional<RhmapConfig> rhmap = RhmapConfig{};
  std::optional<ErasorConfig> erasor = ErasorConfig{};
  std::optional<KthConfig> kth = KthConfig{};
};

/// How many scans evaluate() reads.
std::size_t numReads(const io::ScanSequence& sequence, const EvaluationConfig& config);

/// The rows `no removal`, `oracle` and then `rows`, under each protocol in turn (rhmap, erasor, kth). Calls `progress`
/// after each scan that was read. Throws std::invalid_argument if the window is not in the sequence or a length is
/// wrong, std::runtime_error if scans cannot be read or have no labels,
/// std::out_of_range for points a million cells away or not finite.
std::vector<Score> evaluate(const io::ScanSequence& sequence, const EvaluationConfig& config,
                            std::span<const Estimate> rows = {}, const std::function<void()>& progress = {});

}  // namespace rhmap::eval
