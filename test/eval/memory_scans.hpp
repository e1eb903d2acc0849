// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "rhmap/eval/evaluate.hpp"
#include "rhmap/eval/labelled_scan.hpp"

namespace rhmap::eval::test {

/// A point and its label.
struct Labelled {
  octomap::point3d point;
  std::uint32_t label;
};

/// Scans that a test writes down; the sensor stands at the origin, so both frames are the same.
class MemoryScans : public io::ScanSequence {
 public:
  explicit MemoryScans(const std::vector<std::vector<Labelled>>& scans) {
    for (const auto& points : scans) {
      io::Scan& scan = scans_.emplace_back();
      for (const Labelled& each : points) {
        scan.points.push_back(each.point);
        scan.labels.push_back(each.label);
      }
    }
  }

  std::size_t size() const override { return scans_.size(); }
  io::Scan scan(std::size_t i) const override { return scans_.at(i); }
  std::string name(std::size_t i) const override { return std::to_string(i); }
  bool hasLabels() const override { return true; }

  std::vector<io::Scan>& scans() { return scans_; }

 private:
  std::vector<io::Scan> scans_;
};

/// As it comes to the protocols.
inline LabelledScan labelledScan(const std::vector<Labelled>& points) {
  return readLabelledScan(MemoryScans({points}), 0, {});
}

/// Only this protocol, and no cut around the sensor.
inline EvaluationConfig only(const std::string& protocol) {
  EvaluationConfig config;
  config.erasor->ego_radius = 0;
  if (protocol != "rhmap") config.rhmap.reset();
  if (protocol != "erasor") config.erasor.reset();
  if (protocol != "kth") config.kth.reset();
  return config;
}

/// The score of the row of that name.
inline Score scoreOf(const std::vector<Score>& scores, const std::string& row) {
  for (const Score& score : scores) {
    if (score.row == row) return score;
  }
  throw std::runtime_error("no row " + row);
}

/// What a row gets from one scan's points.
inline Score scoreOf(const EvaluationConfig& config, const std::vector<Labelled>& points, const Estimate& row) {
  return scoreOf(evaluate(MemoryScans({points}), config, {&row, 1}), row.name);
}

/// Kept is what lies below x [m].
inline Estimate keptBelow(float x) {
  return keptBy("row", [x](const octomap::point3d& point) { return point.x() < x; });
}

/// Random scans in a box of 2 m, dense enough for voxels with points of several labels.
inline std::vector<std::vector<Labelled>> randomScans(unsigned seed, int scans, int points) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  constexpr std::uint32_t kLabels[] = {0, 9, 40, 9, 251, 252, 259, 252 | 300U << 16, 1};
  std::vector<std::vector<Labelled>> result(static_cast<std::size_t>(scans));
  for (auto& scan : result) {
    for (int k = 0; k < points; ++k) {
      const float x = unit(random), y = unit(random), z = 0.3F * unit(random);
      scan.push_back({{x, y, z}, kLabels[random() % std::size(kLabels)]});
    }
  }
  return result;
}

}  // namespace rhmap::eval::test
