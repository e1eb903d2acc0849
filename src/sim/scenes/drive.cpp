// SPDX-License-Identifier: BSD-3-Clause
// The scene drive: once round four streets, 3.2 km, back to where it began.
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "../props.hpp"
#include "all.hpp"
#include "street_furniture.hpp"

namespace rhmap::sim {

namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kSpeed = 8;                        // of the carrier [m/s]
constexpr double kDuration = 400;                   // [s]
constexpr double kRadius = 20;                      // of the corners, in the middle of the road [m]
constexpr std::array<double, 2> kSides{1010, 610};  // from corner to corner

/// Street k of the four; they are driven from corner k to corner k + 1, anticlockwise.
StreetLine streetOf(int k) {
  const std::array<Eigen::Vector2d, 4> corners{{{0, 0}, {kSides[0], 0}, {kSides[0], kSides[1]}, {0, kSides[1]}}};
  return {corners[static_cast<std::size_t>(k)] - Eigen::Vector2d(100, 0), k * kPi / 2};
}

/// The way round, d to the left of the middle: points where it bends, first one 100 m after corner 0.
std::vector<Vector3d> lap(double d) {
  std::vector<Vector3d> points{streetOf(0).at(100, d).position};
  for (int k = 0; k < 4; ++k) {
    const StreetLine street = streetOf(k);
    const double straight = kSides[static_cast<std::size_t>(k % 2)] - kRadius;
    for (int i = 0; i <= 20; ++i) {  // a left turn about a centre beside the end of the street
      const double angle = kPi / 2 * i / 20, radius = kRadius - d;
      points.push_back(street.at(straight + radius * std::sin(angle), kRadius - radius * std::cos(angle)).position);
    }
  }
  return points;
}

/// The whole journey: laps, cut at `length` [m] if backwards or not, beginning `start` [m] into the first.
std::vector<Vector3d> journey(double d, double start, double length, bool backwards) {
  std::vector<Vector3d> round = lap(d);
  if (backwards) round = {round.rbegin(), round.rend()};
  std::vector<Vector3d> points;
  double passed = 0;
  for (std::size_t i = 0; passed < start + length; ++i) {
    const Vector3d& a = round[i % round.size()];
    const Vector3d& b = round[(i + 1) % round.size()];
    const double step = (b - a).norm();
    if (passed + step > start) {
      if (points.empty()) points.push_back(a + (b - a) * ((start - passed) / step));
      // Long straights in pieces, so that a turn begins at the corner and not half a street before it.
      points.push_back(b - (b - a) * std::min(1.0, 1 / step));
      points.push_back(b);
    }
    passed += step;
  }
  return points;
}

void addTraffic(SceneBuilder& builder) {
  Random& random = builder.random();
  const double round = 2 * (kSides[0] + kSides[1]);
  const auto drive = [&](Object object, double d, double start, double speed, bool backwards) {
    builder.moveClearOfEgo(std::move(object), pathTrack(journey(d, start, speed * kDuration, backwards), speed, 0),
                           2.5);
  };
  drive(makeVan(), -kLane, 22, kSpeed, false);
  for (double s = 120; s < round - 120; s += random.uniform(100, 250)) drive(makeCar(), -kLane, s, kSpeed, false);
  for (double s = 50; s < round - 100; s += random.uniform(120, 200)) drive(makeCyclist(), -kCycling, s, 5, false);
  int count = 0;
  for (double s = 40; s < round - 60; s += random.uniform(50, 120)) {
    ++count;
    drive(count % 9 == 0 ? makeBus() : count % 4 == 0 ? makeVan() : makeCar(), kLane, s, 9, true);
  }
  for (double s = 80; s < round - 60; s += random.uniform(120, 250)) drive(makeCyclist(), kCycling, s, 5, true);
}

}  // namespace

Scene makeDrive(std::uint64_t seed) {
  SceneBuilder builder("drive", seed, pathTrack(journey(-kLane, 0, kSpeed * kDuration, false), kSpeed, 0), kDuration);
  for (int k = 0; k < 4; ++k) {
    const StreetLine street = streetOf(k);
    const double length = kSides[static_cast<std::size_t>(k % 2)];
    builder.terrain().addPatch({street.at(length / 2, 0).position.head<2>(), {length / 2, kKerb}, street.yaw, kRoad});
    builder.terrain().addPatch({street.at(6, 6).position.head<2>(), {14, 14}, street.yaw, kRoad});
    for (const double s : {-26.0, 4.0}) builder.place(makeBlock(kBuilding, {24, 12, 11}), street.at(s, -20));
    for (const double d : {-4.0, 22.0}) builder.place(makeBlock(kBuilding, {12, 20, 9}), street.at(-20, d));
    furnishStreet(builder, street, 35, length - 35);
    addWalkers(builder, street, 35, length - 35, 25);
    for (double s = 120; s < length - 60; s += 110) {
      const double before = k == 0 ? -100 : k == 1 ? 900 : k == 2 ? 1500 : 2500;  // roughly how far it was to here
      addCrossing(builder, street, s, std::max(0.0, (before + s) / kSpeed - 9.7));
    }
  }
  addTraffic(builder);
  return builder.take();
}

}  // namespace rhmap::sim
