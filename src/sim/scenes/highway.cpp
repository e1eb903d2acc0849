// SPDX-License-Identifier: BSD-3-Clause
// The scene highway: two carriageways with a guard rail between them.
#include <numbers>

#include "../props.hpp"
#include "../scene_builder.hpp"
#include "all.hpp"

namespace rhmap::sim {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSpeed = 25;     // of the carrier [m/s]
constexpr double kDuration = 60;  // [s]
constexpr double kFirst = -120, kLast = 1620;
constexpr double kFastLane = 2.8, kMiddleLane = 6.4, kTruckLane = 10.0;  // middles of the lanes [m]

void addRoadside(SceneBuilder& builder) {
  Random& random = builder.random();
  const double middle = (kFirst + kLast) / 2, half = (kLast - kFirst) / 2;
  for (const double side : {1.0, -1.0}) builder.terrain().addPatch({{middle, side * 7.1}, {half, 6.3}, 0, kRoad});
  for (double x = kFirst; x < kLast; x += 8) {
    for (const double y : {0.0, 14.2, -14.2}) builder.place(makeGuardRail(8), standAt(x + 4, y));
  }
  for (const double side : {1.0, -1.0}) {
    for (double x = kFirst; x < kLast; x += 12) {
      // Stretches of noise barrier and of trees take turns.
      if (static_cast<int>((x - kFirst) / 120 + (side > 0 ? 0 : 1)) % 2 == 0) {
        builder.place(makeBlock(kFence, {12, 0.2, 3.5}), standAt(x + 6, side * 17));
      } else {
        builder.placeTree(standAt(x + random.uniform(0, 8), side * random.uniform(19, 24)), 2.5,
                          random.uniform(2, 3.5));
      }
    }
    for (double x = kFirst + 20; x < kLast; x += 60) builder.place(makePole(9), standAt(x, side * 15.5));
    for (double x = kFirst + 60; x < kLast; x += 300)
      builder.place(makeBlock(kBuilding, {30, 20, random.uniform(6, 10)}), standAt(x, side * 45));
  }
}

void addBridges(SceneBuilder& builder) {
  for (double x = 150; x < kLast; x += 400) {
    builder.place(makeBlock(kOtherStructure, {9, 44, 1.2}, 5.2), standAt(x, 0));
    for (const double y : {16.0, -16.0}) builder.place(makeBlock(kOtherStructure, {7, 1, 5.2}), standAt(x, y));
  }
}

/// One lane, all of it at one speed, so that nobody drives through anybody.
void addLane(SceneBuilder& builder, double y, bool back, double speed, double first, double last, bool trucks) {
  Random& random = builder.random();
  int count = 0;
  for (double x = first; x < last; x += random.uniform(35, 90)) {
    Object object = trucks ? makeTruck() : makeCar();
    if (!trucks && ++count % 4 == 0) object = makeVan();
    if (trucks && ++count % 5 == 0) object = makeBus();
    builder.moveClearOfEgo(std::move(object), straightTrack(standAt(x, y, back ? kPi : 0), speed, 0, kDuration), 2.8);
  }
}

}  // namespace

Scene makeHighway(std::uint64_t seed) {
  SceneBuilder builder("highway", seed, straightTrack(standAt(0, -kMiddleLane), kSpeed, 0, kDuration), kDuration);
  addRoadside(builder);
  addBridges(builder);
  addLane(builder, -kFastLane, false, 33, -500, 60, false);  // they overtake
  addLane(builder, -kMiddleLane, false, 25.5, 25, 200, false);
  addLane(builder, -kTruckLane, false, 22, -20, 300, true);  // they are overtaken
  addLane(builder, kFastLane, true, 34, 20, 3600, false);
  addLane(builder, kMiddleLane, true, 28, 50, 3200, false);
  addLane(builder, kTruckLane, true, 23, 35, 2900, true);
  return builder.take();
}

}  // namespace rhmap::sim
