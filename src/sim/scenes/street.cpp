// SPDX-License-Identifier: BSD-3-Clause
// The scenes street and static: 600 m of town.
#include <numbers>

#include "../props.hpp"
#include "all.hpp"
#include "street_furniture.hpp"

namespace rhmap::sim {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSpeed = 8;                  // of the carrier [m/s]
constexpr double kDuration = 60;              // [s]
constexpr double kFirst = -100, kLast = 580;  // ends of the street [m]

SceneBuilder buildStreet(const char* name, std::uint64_t seed, const StreetLine& street) {
  SceneBuilder builder(name, seed, straightTrack(street.at(0, -kLane), kSpeed, 0, kDuration), kDuration);
  furnishStreet(builder, street, kFirst, kLast);
  return builder;
}

void addTraffic(SceneBuilder& builder, const StreetLine& street) {
  Random& random = builder.random();
  const auto drive = [&](Object object, double s, double d, bool back, double speed) {
    builder.moveClearOfEgo(std::move(object), straightTrack(street.at(s, d, back ? kPi : 0), speed, 0, kDuration), 2.5);
  };
  // One way: a van ahead at the carrier's pace, cyclists whom it overtakes.
  drive(makeVan(), 18, -kLane, false, kSpeed);
  drive(makeCar(), 42, -kLane, false, kSpeed);
  drive(makeCar(), -16, -kLane, false, kSpeed - 0.1);
  for (double s = 15; s < 250; s += random.uniform(25, 45)) drive(makeCyclist(), s, -kCycling, false, 5);
  // The other way: all kinds, and cyclists.
  int count = 0;
  for (double s = 25; s < 1100; s += random.uniform(25, 45)) {
    const int kind = count++ % 4;
    drive(kind == 1 ? makeVan() : kind == 3 && count % 8 == 0 ? makeBus() : makeCar(), s, kLane, true, 9);
  }
  for (double s = 30; s < 700; s += random.uniform(40, 70)) drive(makeCyclist(), s, kCycling, true, 5);
}

}  // namespace

Scene makeStreet(std::uint64_t seed) {
  const StreetLine street;
  SceneBuilder builder = buildStreet("street", seed, street);
  addTraffic(builder, street);
  addWalkers(builder, street, kFirst, kLast, 14);
  // Each is across just before the carrier (and the van ahead of it) comes by.
  for (double s = 45; s < kSpeed * kDuration; s += 55) addCrossing(builder, street, s, s / kSpeed - 9.7);
  return builder.take();
}

Scene makeStatic(std::uint64_t seed) { return buildStreet("static", seed, StreetLine{}).take(); }

}  // namespace rhmap::sim
