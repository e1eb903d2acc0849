// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/eval/evaluate.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace rhmap::eval {
namespace {

std::size_t lastScan(const io::ScanSequence& sequence, const SequenceWindow& window) {
  const std::size_t last = window.last.value_or(sequence.size() - 1);
  if (window.first > last || last >= sequence.size())
    throw std::invalid_argument("scans " + std::to_string(window.first) + "-" + std::to_string(last) +
                                " are not in the sequence; it has 0-" + std::to_string(sequence.size() - 1));
  return last;
}

int numPasses(const EvaluationConfig& config) { return config.kth ? 2 : config.rhmap || config.erasor ? 1 : 0; }

}  // namespace

std::size_t numReads(const io::ScanSequence& sequence, const EvaluationConfig& config) {
  return (lastScan(sequence, config.window) - config.window.first + 1) * static_cast<std::size_t>(numPasses(config));
}

std::vector<Score> evaluate(const io::ScanSequence& sequence, const EvaluationConfig& config,
                            std::span<const Estimate> rows, const std::function<void()>& progress) {
  const std::size_t last = lastScan(sequence, config.window);
  std::vector<Estimate> estimates{noRemoval(), oracle(config.labels)};
  estimates.insert(estimates.end(), rows.begin(), rows.end());

  std::vector<std::unique_ptr<Protocol>> protocols;
  if (config.rhmap) protocols.push_back(makeRhmapProtocol(*config.rhmap, config.labels, estimates));
  if (config.erasor) protocols.push_back(makeErasorProtocol(*config.erasor, config.labels, estimates));
  if (config.kth) protocols.push_back(makeKthProtocol(*config.kth, config.labels, estimates));

  std::vector<KeptMask> masks(estimates.size());
  for (int pass = 0; pass < numPasses(config); ++pass) {
    for (std::size_t i = config.window.first; i <= last; ++i) {
      const LabelledScan scan = readLabelledScan(sequence, i, config.window);
      for (std::size_t r = 0; r < estimates.size(); ++r) {
        if (estimates[r].keep) masks[r] = estimates[r].keep(scan);
      }
      for (const auto& protocol : protocols) {
        if (pass < protocol->passes()) protocol->add(scan, masks);
      }
      if (progress) progress();
    }
    for (const auto& protocol : protocols) {
      if (pass < protocol->passes()) protocol->endPass();
    }
  }

  std::vector<Score> scores;
  for (const auto& protocol : protocols) {
    const auto part = protocol->scores();
    scores.insert(scores.end(), part.begin(), part.end());
  }
  return scores;
}

}  // namespace rhmap::eval
