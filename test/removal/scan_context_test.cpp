// SPDX-License-Identifier: BSD-3-Clause
#include "scan_context.hpp"

#include <gtest/gtest.h>

#include <set>

#include "small_world.hpp"

namespace rhmap {
namespace {

using test::kCube;

TEST(Ratio1, IsTheScansHeightByTheMaps) {
  Context2d scan{.x = 0, .y = 0, .z_min = 100, .z_max = 101, .points = 9, .max_ring = false, .bulge_dented = false};
  EXPECT_DOUBLE_EQ(ratio1(scan, 100, 119, true), 2.0 / 20);
  scan.max_ring = true;  // its highest point is where the field of view ends
  EXPECT_DOUBLE_EQ(ratio1(scan, 98, 119, true), 2.0 / 4);
  EXPECT_DOUBLE_EQ(ratio1(scan, 98, 119, false), 2.0 / 22);
}

TEST(Ratio2, IsTheScansHeightByTheRegions) {
  const Context3d scan{.x = 0, .y = 0, .z = 0, .z_min = 10, .z_max = 11, .sup = 20, .inf = 0};
  EXPECT_DOUBLE_EQ(ratio2(scan, 8, 15), 2.0 / 8);
}

/// A scan of a wall and the ground, with a bar in front of the wall.
struct Scene {
  Scene() {
    octomap::Pointcloud cloud = test::wallAndGround(20);
    for (octomap::point3d& p : cloud)
      if (std::abs(p.y()) < 3 && p.z() > -0.5F && p.z() < 0.3F) p *= 10 / p.x();
    points = test::scanOf(cloud);
    image = RangeImage(measureProjection({}, points), points);
    trace = test::trace(map, points, sensor, 1, {.reach = 50, .resolution = kCube});
    for (std::size_t i = 0; i < trace.columns.size(); ++i)
      *grid.at(trace.columns[i].column->x, trace.columns[i].column->y) = static_cast<std::int32_t>(i);
  }
  OcTreeKey sensor{kTreeMaxVal, kTreeMaxVal, kTreeMaxVal};
  ScanPoints points;
  RangeImage image;
  RegionMap map = test::emptyMap();
  ScanTrace trace;
  ColumnGrid grid{map, sensor, 50, kCube};
};

TEST(BulgeDented, PointsHaveANearerOneAboveOrBelow) {
  Scene scene;
  const ContextConfig config;
  const auto contexts = findBulgeDented(scene.image, scene.points, config, scene.map, scene.grid, scene.trace);
  // Eqs. (9) and (10), pixel by pixel.
  std::set<std::tuple<int, int, int>> expected;
  for (int i = 0; i < scene.image.projection().rows; ++i) {
    for (int j = 0; j < scene.image.projection().columns; ++j) {
      const std::int32_t k = scene.image.pointAt(i, j);
      if (k < 0 || scene.image.at(i, j) > static_cast<float>(config.max_range)) continue;
      bool nearer = false;
      for (int other = 0; other < scene.image.projection().rows; ++other)
        nearer =
            nearer || scene.image.at(i, j) - scene.image.at(other, j) > std::max(1.0F, 0.02F * scene.image.at(i, j));
      const OcTreeKey cube = scene.points.cubeAt(static_cast<std::size_t>(k));
      if (nearer) expected.insert({cube[0] >> 3, cube[1] >> 3, cube[2] >> 3});
    }
  }
  ASSERT_GT(expected.size(), 100U);
  ASSERT_EQ(contexts.size(), expected.size());
  for (const Context3d& context : contexts) {
    EXPECT_TRUE(expected.count({context.x, context.y, context.z}));
    EXPECT_LE(context.z_min, context.z_max);
    EXPECT_GE(context.z_min >> 3, context.z);
    EXPECT_LE(context.z_max >> 3, context.z);
  }
}

TEST(BulgeDented, BoundsOfTheWallAboveTheBarAreTheBar) {
  Scene scene;
  const auto contexts = findBulgeDented(scene.image, scene.points, {}, scene.map, scene.grid, scene.trace);
  int above = 0;
  for (const Context3d& context : contexts) {
    const double x = (context.x * 8 - int{kTreeMaxVal}) * kCube, y = (context.y * 8 - int{kTreeMaxVal}) * kCube;
    if (x < 19 || std::abs(y) > 3 || context.z_min < kTreeMaxVal + 8) continue;
    ++above;
    EXPECT_GE(context.inf, kTreeMaxVal - 6);  // seen over the bar's top
    EXPECT_LE(context.inf, kTreeMaxVal + 3);
    EXPECT_EQ(context.sup, context.z_max);  // nothing nearer above
  }
  EXPECT_GT(above, 3);
}

TEST(MaxRing, IsWhereTheHighestBeamsMeetSomething) {
  Scene scene;
  findMaxRing(scene.image, scene.points, scene.map, scene.grid, scene.trace);
  int marked = 0;
  for (const ScanColumn& column : scene.trace.columns) {
    if (!column.max_ring) continue;
    ++marked;
    EXPECT_GT(column.z_max, kTreeMaxVal + 25);  // 20 m away, 9 degrees up
  }
  EXPECT_GT(marked, 10);
}

}  // namespace
}  // namespace rhmap
