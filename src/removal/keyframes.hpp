// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <deque>
#include <optional>

#include "range_image.hpp"
#include "rhmap/removal/removal_config.hpp"
#include "scan_context.hpp"

namespace rhmap {

/// V, Eq. (14): the share of the circle of radius r_max that the scan sees [%].
double informationContent(const RangeImage& image, double r_max);

/// The back end's queue of keyframes (Sec. III-D).
class Keyframes {
 public:
  explicit Keyframes(const BackEndConfig& config) : config_(config) {}

  /// Whether a scan seen from here [m] is a keyframe: far, long or different enough from the last.
  bool wants(const std::array<float, 3>& position, std::uint32_t scan, double information);
  void push(const std::array<float, 3>& position, ScanContext context) {
    waiting_.push_back({position, std::move(context)});
  }
  /// The next keyframe that the sensor, now here [m], has left behind, if any.
  std::optional<ScanContext> pop(const std::array<float, 3>& position);
  /// The next keyframe, if any.
  std::optional<ScanContext> pop();

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
  std::optional<Last> last_;
  std::deque<Keyframe> waiting_;
};

}  // namespace rhmap
