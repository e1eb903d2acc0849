// SPDX-License-Identifier: BSD-3-Clause
#include "ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "small_world.hpp"

namespace rhmap {
namespace {

using test::cubeAt;
using test::emptyMap;
using test::kCube;

std::vector<LocalCube> slope(double dx, double dy) {
  std::vector<LocalCube> cubes;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y) cubes.push_back({x, y, static_cast<int>(std::floor(2 + dx * x + dy * y))});
  return cubes;
}

TEST(GroundPlane, OfASlopeIsTheSlope) {
  const auto plane = fitGround(slope(0.25, 0), {}, kCube);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(-plane->n[0] / plane->n[2], 0.25, 0.07);
  EXPECT_NEAR(plane->n[1], 0, 0.05);
}

TEST(GroundPlane, OfOneLayerIsLevel) {  // no cube is lower than the mean
  const auto plane = fitGround(slope(0, 0), {}, kCube);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->n[2], 1, 1e-6);
  EXPECT_NEAR(plane->above(3, 3, 2), 0, 1e-5);
}

TEST(GroundPlane, IsNotDrawnUpByWhatStandsOnTheGround) {
  std::vector<LocalCube> cubes = slope(0, 0);
  for (int x = 5; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 3; z < 8; ++z) cubes.push_back({x, y, z});
  const auto plane = fitGround(cubes, {}, kCube);
  ASSERT_TRUE(plane);
  EXPECT_GT(plane->n[2], 0.97);
  EXPECT_LT(std::fabs(plane->above(1, 4, 2)), 1);
}

TEST(GroundPlane, IsNoneOfAWallNorOfAFewCubes) {
  std::vector<LocalCube> wall;
  for (int y = 0; y < 8; ++y)
    for (int z = 0; z < 8; ++z) wall.push_back({3, y, z});
  EXPECT_FALSE(fitGround(wall, {}, kCube));
  const auto few = slope(0, 0);
  EXPECT_FALSE(fitGround(std::span(few).first(5), {}, kCube));
}

/// The world as cubes, inserted scan by scan, with the ground estimated after each.
class Ground {
 public:
  explicit Ground(const GroundConfig& config = {}) : estimation_(config, kCube) {}

  void insert(const std::vector<OcTreeKey>& cubes) {
    estimation_.update(map_, test::trace(map_, test::pointsIn(cubes), cubeAt(0, 0, 0), ++scan_, {.resolution = kCube}));
  }
  static std::vector<OcTreeKey> plate(int x0, int x1, int z) {
    std::vector<OcTreeKey> cubes;
    for (int x = x0; x < x1; ++x)
      for (int y = 0; y < 24; ++y) cubes.push_back(cubeAt(x, y, z));
    return cubes;
  }
  bool is(const OcTreeKey& cube) const {
    return (map_.regionOf(cube)->octant(map_.octantOf(cube)).ground & maskOf(bitOf(cube))) != 0;
  }
  /// Whether the removal has to look at the octant of a cube.
  bool isLoose(const OcTreeKey& cube) const {
    return (map_.regionOf(cube)->loose_octants >> map_.octantOf(cube) & 1) != 0;
  }
  bool isSafe(const OcTreeKey& cube) const {
    return (map_.regionOf(cube)->octant(map_.octantOf(cube)).safe & maskOf(bitOf(cube))) != 0;
  }

 private:
  RegionMap map_ = emptyMap();
  GroundEstimation estimation_;
  std::uint32_t scan_ = 0;
};

TEST(GroundEstimation, TellsARoadFromABoxOnIt) {
  Ground ground;
  auto cubes = Ground::plate(0, 24, 2);
  for (int x = 10; x < 14; ++x)
    for (int y = 10; y < 14; ++y)
      for (int z = 3; z < 12; ++z) cubes.push_back(cubeAt(x, y, z));
  ground.insert(cubes);
  EXPECT_TRUE(ground.is(cubeAt(1, 1, 2)));
  EXPECT_TRUE(ground.isSafe(cubeAt(1, 1, 2)));
  EXPECT_TRUE(ground.is(cubeAt(11, 11, 3)));  // within r_gro
  EXPECT_FALSE(ground.isSafe(cubeAt(11, 11, 3)));
  EXPECT_FALSE(ground.is(cubeAt(11, 11, 5)));
  EXPECT_FALSE(ground.is(cubeAt(11, 11, 11)));
}

TEST(GroundEstimation, TheRoofOfACarIsNoneOnceTheRoadIsSeen) {
  Ground ground;
  ground.insert(Ground::plate(0, 24, 18));
  EXPECT_TRUE(ground.is(cubeAt(12, 12, 18)));
  EXPECT_FALSE(ground.isLoose(cubeAt(12, 12, 18)));
  ground.insert(Ground::plate(0, 24, 2));
  EXPECT_FALSE(ground.is(cubeAt(12, 12, 18)));
  EXPECT_TRUE(ground.isLoose(cubeAt(12, 12, 18)));
  EXPECT_TRUE(ground.is(cubeAt(12, 12, 2)));
}

TEST(GroundEstimation, WhatIsFarBelowAPlaneIsNotItsGround) {
  for (const double depth : {0.2, 0.0}) {
    Ground ground({.depth = depth});
    auto cubes = Ground::plate(0, 16, 7);
    for (const int z : {1, 3, 6}) cubes.push_back(cubeAt(17, 12, z));  // too few for a plane of their own
    ground.insert(cubes);
    EXPECT_TRUE(ground.isSafe(cubeAt(17, 12, 6)));
    EXPECT_EQ(ground.isSafe(cubeAt(17, 12, 3)), depth == 0);
    EXPECT_EQ(ground.is(cubeAt(17, 12, 1)), depth == 0);
  }
}

TEST(GroundEstimation, DoesNotClimbSteps) {
  Ground ground;
  ground.insert(Ground::plate(0, 8, 2));
  ground.insert(Ground::plate(8, 16, 7));  // beside it, half a metre up
  EXPECT_TRUE(ground.is(cubeAt(4, 12, 2)));
  EXPECT_FALSE(ground.is(cubeAt(12, 12, 7)));
}

TEST(GroundEstimation, IsNotFarAboveAThirdOfTheGroundAround) {
  // Roads begin 2.4 m from a top on both sides of it.
  const auto topIsGround = [](const GroundConfig& config, int height, bool roads) {
    Ground ground(config);
    if (roads) ground.insert(Ground::plate(-160, -8, 2));
    if (roads) ground.insert(Ground::plate(48, 200, 2));
    ground.insert(Ground::plate(16, 24, 2 + height));
    return ground.is(cubeAt(20, 12, 2 + height));
  };
  EXPECT_FALSE(topIsGround({}, 13, true));
  EXPECT_TRUE(topIsGround({}, 8, true));
  EXPECT_TRUE(topIsGround({.raised = 1.5}, 13, true));
  EXPECT_TRUE(topIsGround({.rise = 0.5}, 13, true));
  EXPECT_TRUE(topIsGround({.around = 0}, 13, true));
  EXPECT_TRUE(topIsGround({}, 13, false));

  Ground ground;
  ground.insert(Ground::plate(-160, -8, 2));
  ground.insert(Ground::plate(48, 200, 15));  // as high as the top: half of all are below
  ground.insert(Ground::plate(16, 24, 15));
  EXPECT_TRUE(ground.is(cubeAt(100, 12, 15)));
  EXPECT_FALSE(ground.is(cubeAt(20, 12, 15)));

  Ground slope;
  slope.insert(Ground::plate(-160, -8, 2));
  slope.insert(Ground::plate(48, 200, 28));  // as much is above as below
  slope.insert(Ground::plate(16, 24, 15));
  EXPECT_TRUE(slope.is(cubeAt(20, 12, 15)));
}

TEST(GroundEstimation, GoesOnAcrossTheBordersOfRegions) {
  for (const bool across : {true, false}) {
    GroundConfig config;
    config.across_regions = across;
    Ground ground(config);
    auto cubes = Ground::plate(0, 24, 7);  // the highest layer of its regions
    for (int i = 8; i < 12; ++i) cubes.push_back(cubeAt(i, i, 8));
    ground.insert(cubes);
    EXPECT_TRUE(ground.is(cubeAt(9, 10, 7)));
    EXPECT_EQ(ground.is(cubeAt(9, 9, 8)), across);
  }
}

}  // namespace
}  // namespace rhmap
