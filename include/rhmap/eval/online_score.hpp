// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>

#include "rhmap/eval/estimate.hpp"
#include "rhmap/eval/score.hpp"

namespace rhmap::eval {

/// How good the map is while it grows: each scan's labelled points are judged right after their insertion, and again
/// when `lag` further scans have been inserted. Holds the last `lag` scans.
///
///     OnlineScore online(labels);
///     for (...) { mapper.insert(scan); online.add(scan, map_now); }
class OnlineScore {
 public:
  /// `lag` in scans, at least 1; 10 are one second of a 10 Hz LiDAR. std::invalid_argument if it is 0.
  explicit OnlineScore(Labels labels, std::size_t lag = 10);

  /// After `scan` was inserted; `now` answers for the map as it is now, e.g. keptInMap(). Estimates that are clouds
  /// throw std::invalid_argument.
  void add(LabelledScan scan, const Estimate& now);

  /// Points of all scans so far, each judged with the map right after its own scan.
  const Counts& atOnce() const { return at_once_; }

  /// Points of all scans but the last `lag`, each judged with the map `lag` scans later.
  const Counts& later() const { return later_; }

 private:
  void judge(const LabelledScan& scan, const Estimate& now, Counts& counts) const;

  Labels labels_;
  std::size_t lag_;
  std::deque<LabelledScan> waiting_;
  Counts at_once_;
  Counts later_;
};

}  // namespace rhmap::eval
