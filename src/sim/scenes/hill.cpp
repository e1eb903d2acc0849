// SPDX-License-Identifier: BSD-3-Clause
// The scene hill: a road that goes up and down between a bank and a drop, under rock, a bridge and branches.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "../props.hpp"
#include "../scene_builder.hpp"
#include "all.hpp"

namespace rhmap::sim {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSpeed = 6;      // of the carrier [m/s]
constexpr double kDuration = 50;  // [s]

double smoothStep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// Waves of 6 m along the road (slopes of up to 14 %), 5 m of bank to the left, 3 m of drop to the right.
double heightAt(double x, double y) {
  const double waves = 3 * (1 - std::cos(x / 22));
  return waves + 5 * smoothStep((y - 8) / 14) - 3 * smoothStep((-y - 8) / 14);
}

HeightGrid makeHeights() {
  HeightGrid grid{.corner = {-150, -120}, .cell = 2, .columns = 326, .rows = 121, .heights = {}};
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const double x = grid.corner.x() + grid.cell * static_cast<double>(column);
      const double y = grid.corner.y() + grid.cell * static_cast<double>(row);
      const std::size_t to_border = std::min({row, column, grid.rows - 1 - row, grid.columns - 1 - column});
      grid.heights.push_back(to_border == 0 ? 0 : heightAt(x, y) * smoothStep(static_cast<double>(to_border) / 20));
    }
  }
  return grid;
}

void addOverhangs(SceneBuilder& builder) {
  Random& random = builder.random();
  // Rock that leans out from the bank to above the road.
  for (const double x : {35.0, 140.0, 230.0}) {
    builder.place(makeBlock(kTerrain, {14, 6, 5}), standAt(x, 12));
    builder.place(makeBlock(kTerrain, {12, 9, 2}, 4.2), standAt(x, 6.5, 0.05));
  }
  builder.place(makeBlock(kOtherStructure, {6, 24, 1}, 5), standAt(90, 0));
  for (const double y : {9.0, -9.0}) builder.place(makeBlock(kOtherStructure, {4, 1, 8}, -2), standAt(90, y));
  for (double x = -80; x < 400; x += random.uniform(12, 20)) {
    builder.placeTree(standAt(x, -6.5), 3, random.uniform(2.2, 3));
    builder.placeTree(standAt(x + 8, random.uniform(16, 40)), 2.2, random.uniform(2, 3.5));
    builder.placeTree(standAt(x + 4, -random.uniform(14, 40)), 2.2, random.uniform(2, 3.5));
  }
  for (double x = -90; x < 400; x += 8) builder.place(makeGuardRail(8), standAt(x + 4, -5));
  for (double x = -70; x < 400; x += 45) builder.place(makePole(7), standAt(x, 5));
  for (const double x : {60.0, 180.0, 300.0}) {
    builder.place(makeBlock(kBuilding, {12, 10, 9}, -2), standAt(x, 28));
    builder.place(makeCar(), standAt(x + 10, 5.6));
  }
}

void addTraffic(SceneBuilder& builder) {
  Random& random = builder.random();
  const auto go = [&](Object object, double x, double y, bool back, double speed) {
    builder.moveClearOfEgo(std::move(object), straightTrack(standAt(x, y, back ? kPi : 0), speed, 0, kDuration), 2.5);
  };
  go(makeTractor(), 22, -1.8, false, kSpeed);
  go(makeCar(), 45, -1.8, false, kSpeed + 1);
  for (double x = 40; x < 900; x += random.uniform(40, 80)) go(makeCar(), x, 1.8, true, 10);
  for (double x = 60; x < 500; x += random.uniform(50, 90)) go(makeCyclist(), x, 3.3, true, 5);
  // Walkers on the road's edge, and some straight up and down the bank.
  for (double x = 20; x < 400; x += random.uniform(20, 35)) go(makePerson(), x, 4.3, random.chance(0.5), 1.4);
  for (double x = 15; x < 320; x += 35) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 8; ++i) points.emplace_back(x, i % 2 == 0 ? 7 : 24, 0);
    builder.move(makePerson(), pathTrack(points, 1.4, -random.uniform(0, 12)));
  }
}

}  // namespace

Scene makeHill(std::uint64_t seed) {
  SceneBuilder builder("hill", seed, straightTrack(standAt(0, -1.8), kSpeed, 0, kDuration), kDuration);
  builder.terrain().setHeights(makeHeights());
  builder.terrain().addPatch({{175, 0}, {325, 4}, 0, kRoad});
  addOverhangs(builder);
  addTraffic(builder);
  return builder.take();
}

}  // namespace rhmap::sim
