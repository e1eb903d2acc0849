// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace rhmap {

/// The log-odds that an insertion works with.
struct SensorModel {
  float hit, miss;  ///< added to a cell that is hit / crossed
  float clamp_min, clamp_max;

  /// OctoMap's early abort: this update leaves a cell with this value as it is, and does not even expand a pruned leaf.
  bool settled(float value, float update) const {
    return (update >= 0 && value >= clamp_max) || (update <= 0 && value <= clamp_min);
  }
  float updated(float value, float update) const {
    value += update;
    return value < clamp_min ? clamp_min : value > clamp_max ? clamp_max : value;
  }
};

}  // namespace rhmap
