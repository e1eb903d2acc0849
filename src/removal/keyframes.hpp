// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <deque>
#include <optional>

#include "scan_to_map.hpp"

namespace rhmap {

/// V, Eq. (14): the share of the circle of radius r_max that the scan sees [%].
double informationContent(const RangeImage& image, double r_max);

/// The back end's queue of keyframes (Sec. III-D).
class Keyframes {
 public:
  Keyframes(const BackEndConfig& config, double r_max) : config_(config), r_max_(r_max) {}

  /// Whether a scan seen from here [m] is a keyframe: far, long or different enough from the last.
  bool wants(const std::array<float, 3>& position, std::uint32_t scan, double information);
  void push(const std::array<float, 3>& position, ScanContext context) {
    waiting_.push_back({position, std::move(context)});
  }
  /// The next keyframe that the sensor, now here [m], has left behind, if any.
  std::optional<ScanContext> pop(const std::array<float, 3>& position);
  /// The next keyframe, if any.
  std::optional<ScanContext> pop();

  double rMax() const { return r_max_; }

 private:
  struct Keyframe {
    std::array<float, 3> position;
    ScanContext context;
  };
  struct Last {
    std::array<float, 3> position;
    std::uint32_t scan;
    double information;
  };
  BackEndConfig config_;
  double r_max_;
  std::optional<Last> last_;
  std::deque<Keyframe> waiting_;
};

}  // namespace rhmap
