// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/terrain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "rhmap/sim/random.hpp"
#include "rhmap/sim/shape.hpp"

namespace rhmap::sim::test {
namespace {

using Eigen::Vector3d;

/// Waves on 20 m x 14 m with a flat border.
Terrain waves() {
  HeightGrid grid{.corner = {-10, -7}, .cell = 0.5, .columns = 41, .rows = 29, .heights = {}};
  for (std::size_t y = 0; y < grid.rows; ++y) {
    for (std::size_t x = 0; x < grid.columns; ++x) {
      const bool border = x == 0 || y == 0 || x + 1 == grid.columns || y + 1 == grid.rows;
      const double u = static_cast<double>(x), v = static_cast<double>(y);
      grid.heights.push_back(border ? 0 : std::sin(u / 4) * std::cos(v / 5));
    }
  }
  Terrain terrain;
  terrain.setHeights(grid);
  return terrain;
}

TEST(Terrain, IsFlatByDefault) {
  const Terrain terrain;
  const double s = std::sqrt(0.5);
  EXPECT_EQ(terrain.height(3, 4), 0);
  EXPECT_NEAR(terrain.hitDistance({0, 0, 2}, {s, 0, -s}, 100), 2 / s, 1e-12);
  EXPECT_EQ(terrain.hitDistance({0, 0, 2}, {s, 0, -s}, 1), kNoHit) << "out of range";
  EXPECT_EQ(terrain.hitDistance({0, 0, 2}, {1, 0, 0}, 100), kNoHit);
}

TEST(Terrain, LaterPatchesLieOverEarlierOnes) {
  Terrain terrain(kTerrain);
  terrain.addPatch({{0, 0}, {10, 2}, 0, kRoad});
  terrain.addPatch({{0, 0}, {10, 1}, std::numbers::pi / 2, kSidewalk});
  EXPECT_EQ(terrain.classAt(5, 0), kRoad);
  EXPECT_EQ(terrain.classAt(0.5, 0), kSidewalk);
  EXPECT_EQ(terrain.classAt(0.5, 9), kSidewalk);
  EXPECT_EQ(terrain.classAt(5, 9), kTerrain);
}

TEST(Terrain, WantsAFlatBorder) {
  Terrain terrain;
  EXPECT_THROW(terrain.setHeights({{0, 0}, 1, 2, 2, {0, 0, 0, 1}}), std::invalid_argument);
  EXPECT_THROW(terrain.setHeights({{0, 0}, 1, 2, 2, {0, 0, 0}}), std::invalid_argument);
}

TEST(Terrain, ARayMeetsTheHeightsWhereWalkingAlongItDoes) {
  constexpr double kStep = 1e-3;
  const Terrain terrain = waves();
  Random random(5, 0);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d origin(random.uniform(-14, 14), random.uniform(-10, 10), random.uniform(1.1, 3));
    const Vector3d direction =
        Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.4, 0.05)).normalized();
    const double hit = terrain.hitDistance(origin, direction, 25);
    double walked = 0;
    const auto above = [&](double t) {
      const Vector3d point = origin + t * direction;
      return point.z() - terrain.height(point.x(), point.y());
    };
    while (walked < 25 && above(walked) > 0) walked += kStep;
    if (walked >= 25) {
      if (hit != kNoHit) {  // steps may jump over a crest
        EXPECT_NEAR(above(hit), 0, 1e-9);
      }
      continue;
    }
    ++hits;
    EXPECT_NEAR(above(hit), 0, 1e-9);
    EXPECT_LE(hit, walked + 1e-6);
    EXPECT_GE(hit, walked - kStep - 1e-6);
  }
  EXPECT_GT(hits, 100);
}

TEST(Terrain, NormalsStandOnTheSlopes) {
  const Terrain terrain = waves();
  Random random(6, 0);
  for (int i = 0; i < 100; ++i) {
    const double x = random.uniform(-9, 9), y = random.uniform(-6, 6);
    const Vector3d normal = terrain.normal(x, y);
    const double dx = (terrain.height(x + 1e-6, y) - terrain.height(x, y)) / 1e-6;
    EXPECT_NEAR(normal.dot(Vector3d(1, 0, dx).normalized()), 0, 1e-3);
  }
}

}  // namespace
}  // namespace rhmap::sim::test
