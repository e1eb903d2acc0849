// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "../scene_builder.hpp"

namespace rhmap::sim {

/// A straight street: s runs along it, d to the left of its middle [m].
struct StreetLine {
  Eigen::Vector2d origin{0, 0};
  double yaw = 0;

  Stance at(double s, double d, double turn = 0, double z = 0) const;
};

// Measures of a street [m]: two lanes, two parking strips, kerb, sidewalk, front of the houses.
constexpr double kLane = 1.9;
constexpr double kCycling = 3.5;
constexpr double kParked = 5.0;
constexpr double kKerb = 6.0;
constexpr double kKerbHeight = 0.12;
constexpr double kSidewalkEnd = 9.5;
constexpr double kFront = 11.0;

/// Road, sidewalks, houses, fences, trees, poles, parked cars and bicycles, and people who stand about, from s = first
/// to last.
void furnishStreet(SceneBuilder& builder, const StreetLine& street, double first, double last);

/// People who walk up and down the sidewalks between s = first and last, one for each `spacing` and side.
void addWalkers(SceneBuilder& builder, const StreetLine& street, double first, double last, double spacing);

/// Somebody who crosses from left to right at s, setting out at a time [s].
void addCrossing(SceneBuilder& builder, const StreetLine& street, double s, double time);

}  // namespace rhmap::sim
