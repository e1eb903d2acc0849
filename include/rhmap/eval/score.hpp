// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "rhmap/eval/labels.hpp"

namespace rhmap::eval {

/// Of so many so many are still in the map.
struct Survivors {
  std::size_t total = 0;
  std::size_t kept = 0;

  bool operator==(const Survivors&) const = default;
};

/// What is left of the labelled cells or points. All rates are fractions of 1, and absent where they would divide by
/// zero.
struct Counts {
  Survivors still;                             ///< static ones
  Survivors moving;                            ///< dynamic ones
  std::map<std::uint16_t, Survivors> classes;  ///< the dynamic ones by class; only classes that occur

  bool operator==(const Counts&) const = default;

  /// Counts one of the class of `label`; ignored labels are not counted.
  void add(const Labels& labels, std::uint32_t label, bool kept);

  /// The dynamic ones of the classes from `first` to `last`, both included.
  Survivors movingOf(std::uint16_t first, std::uint16_t last) const;

  /// PR of cells, SA of points: how much of the static world is kept.
  std::optional<double> staticKept() const;

  /// RR of cells, DA of points: how much of the dynamic is gone.
  std::optional<double> dynamicRemoved() const;

  /// F1 of cells, HA of points: their harmonic mean; 0 if both are 0. Absent if one of them is.
  std::optional<double> harmonicMean() const;

  /// AA of points: their geometric mean. Absent if one of them is.
  std::optional<double> geometricMean() const;
};

/// 1 - kept / total; absent if there is none.
std::optional<double> removed(const Survivors& survivors);

/// One row under one protocol.
struct Score {
  std::string protocol;                         ///< "rhmap", "erasor" or "kth"
  std::string row;                              ///< the estimate's name
  std::optional<Counts> cells = std::nullopt;   ///< PR, RR, F1: protocols `rhmap` and `erasor`
  std::optional<Counts> points = std::nullopt;  ///< SA, DA, AA, HA: protocols `kth` and, by whole cubes, `rhmap`
  std::size_t static_cells = 0;   ///< cells of the estimate that carry no dynamic label (protocols with cells)
  std::size_t dynamic_cells = 0;  ///< cells of the estimate that carry a dynamic one
};

}  // namespace rhmap::eval
