// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <cmath>
#include <cstdint>

#include "rhmap/core/key.hpp"

namespace rhmap {

/// Conversion between metres and keys at one resolution, with OctoMap's arithmetic: scale by 1/resolution in double,
/// floor, shift by 32768. Never divides by the resolution, as OctoMap never does.
class KeySpace {
 public:
  /// Edge length of a cell [m].
  explicit KeySpace(double resolution) : resolution_(resolution), factor_(1. / resolution) {}

  const double& resolution() const { return resolution_; }
  const double& inverseResolution() const { return factor_; }

  /// Edge length [m] of a node at this depth.
  double nodeSize(unsigned depth) const { return resolution_ * double(1U << (kTreeDepth - depth)); }

  /// Key without a range check: wraps around where the coordinate is outside, as OctoMap does.
  key_type coordToKey(double x) const { return toKey(cell(x)); }

  /// Centre key at a depth, without a range check.
  key_type coordToKey(double x, unsigned depth) const { return atDepth(cell(x), depth); }

  /// False, and `key` untouched, if the coordinate is outside of the tree or not finite.
  bool coordToKeyChecked(double x, key_type& key) const {
    const double scaled = factor_ * x;
    if (!(scaled >= -double(kTreeMaxVal) && scaled < double(kTreeMaxVal))) return false;
    const int towards_zero = static_cast<int>(scaled);  // std::floor is a call where SSE 4.1 is not taken for granted
    key = static_cast<key_type>(towards_zero - (towards_zero > scaled) + kTreeMaxVal);
    return true;
  }

  /// On failure the components before the one outside are already written, as OctoMap leaves them.
  bool coordToKeyChecked(const point3d& p, OcTreeKey& key) const {
    return coordToKeyChecked(double(p.x()), double(p.y()), double(p.z()), key);
  }
  bool coordToKeyChecked(double x, double y, double z, OcTreeKey& key) const {
    return coordToKeyChecked(x, key[0]) && coordToKeyChecked(y, key[1]) && coordToKeyChecked(z, key[2]);
  }

  /// Centre key at `depth` of the node that holds `key`; at depth 0 that is 0.
  static key_type adjustKeyAtDepth(key_type key, unsigned depth) {
    return depth == kTreeDepth ? key : atDepth(int(key) - kTreeMaxVal, depth);
  }
  static OcTreeKey adjustKeyAtDepth(const OcTreeKey& key, unsigned depth) {
    return {adjustKeyAtDepth(key[0], depth), adjustKeyAtDepth(key[1], depth), adjustKeyAtDepth(key[2], depth)};
  }

  /// Coordinate [m] of the cell's centre.
  double keyToCoord(key_type key) const { return (double(int(key) - int(kTreeMaxVal)) + 0.5) * resolution_; }

  /// Coordinate [m] of the centre of the node at `depth` that holds `key`.
  double keyToCoord(key_type key, unsigned depth) const {
    if (depth == 0) return 0.0;
    if (depth == kTreeDepth) return keyToCoord(key);
    const int node = (int(key) - int(kTreeMaxVal)) >> (kTreeDepth - depth);  // the floor of the quotient
    return (double(node) + 0.5) * nodeSize(depth);
  }

  point3d keyToCoord(const OcTreeKey& key) const {
    return {float(keyToCoord(key[0])), float(keyToCoord(key[1])), float(keyToCoord(key[2]))};
  }
  point3d keyToCoord(const OcTreeKey& key, unsigned depth) const {
    return {float(keyToCoord(key[0], depth)), float(keyToCoord(key[1], depth)), float(keyToCoord(key[2], depth))};
  }

 private:
  /// Cell number, counted from coordinate 0. What int cannot hold becomes INT_MIN, as an x86 conversion does.
  int cell(double x) const {
    const double scaled = std::floor(factor_ * x);
    return scaled >= -2147483648.0 && scaled <= 2147483647.0 ? static_cast<int>(scaled) : INT32_MIN;
  }

  static key_type atDepth(int cell, unsigned depth) {
    const unsigned drop = kTreeDepth - depth;
    return drop == 0 ? toKey(cell) : toKey(((cell >> drop) << drop) | (1 << (drop - 1)));
  }
  static key_type toKey(int cell) { return static_cast<key_type>(static_cast<unsigned>(cell) + kTreeMaxVal); }

  double resolution_;
  double factor_;
};

}  // namespace rhmap
