// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "memory_scans.hpp"

namespace rhmap::eval::test {
namespace {

// Cubes of 0.1 m: a point at (k + 0.5) / 10 is in the middle of cube k.
octomap::point3d inCube(int cube, float offset = 0) { return {0.1F * static_cast<float>(cube) + 0.05F + offset, 0, 0}; }

Score scoreOf(const std::vector<Labelled>& points, const Estimate& row) {
  return test::scoreOf(only("rhmap"), points, row);
}

TEST(RhmapProtocol, ACubeHasTheLabelOfItsMajority) {
  const auto score =
      scoreOf({{inCube(0), 9}, {inCube(0), 252}, {inCube(0), 252}, {inCube(1), 252}, {inCube(1), 9}, {inCube(1), 9}},
              keptBelow(1));
  EXPECT_EQ(score.cells->still, (Survivors{1, 1}));
  EXPECT_EQ(score.cells->moving, (Survivors{1, 1}));
  EXPECT_EQ(score.static_cells, 1U);
  EXPECT_EQ(score.dynamic_cells, 1U);
}

TEST(RhmapProtocol, ATieIsStatic) {
  const auto score = scoreOf({{inCube(0), 9}, {inCube(0), 252}}, keptBelow(1));
  EXPECT_EQ(score.cells->still, (Survivors{1, 1}));
  EXPECT_EQ(score.cells->moving, (Survivors{0, 0}));
}

TEST(RhmapProtocol, IgnoredPointsNeitherVoteNorMakeACubeCount) {
  const auto score =
      scoreOf({{inCube(0), 0}, {inCube(0), 0}, {inCube(0), 0}, {inCube(0), 252}, {inCube(1), 0}}, keptBelow(1));
  EXPECT_EQ(score.cells->still, (Survivors{0, 0}));
  EXPECT_EQ(score.cells->moving, (Survivors{1, 1}));
  EXPECT_FALSE(score.cells->staticKept());
  EXPECT_EQ(score.cells->dynamicRemoved(), 0.0);
}

TEST(RhmapProtocol, ACubeThatIsGoneIsGone) {
  const auto score =
      scoreOf({{inCube(0), 9}, {inCube(1), 9}, {inCube(2), 252}, {inCube(3), 254}, {inCube(0), 252}}, keptBelow(0.1F));
  EXPECT_EQ(*score.cells, (Counts{.still = {2, 1}, .moving = {2, 0}, .classes = {{252, {1, 0}}, {254, {1, 0}}}}));
  // By points: the moving one in the cube that stays, stays.
  EXPECT_EQ(*score.points, (Counts{.still = {2, 1}, .moving = {3, 1}, .classes = {{252, {2, 1}}, {254, {1, 0}}}}));
}

TEST(RhmapProtocol, ACubeCarriesTheLabelOfWhatIsKeptOfIt) {
  // The cube moves, but what is kept of it does not: rejected, although the cube survives.
  const auto moving =
      scoreOf({{inCube(0, 0.02F), 252}, {inCube(0, 0.02F), 252}, {inCube(0, -0.02F), 9}}, keptBelow(0.05F));
  EXPECT_EQ(moving.cells->moving, (Survivors{1, 0}));
  EXPECT_EQ(moving.points->moving, (Survivors{2, 2}));
  EXPECT_EQ(moving.static_cells, 1U);
  // And a static cube of which only the moving part is kept is lost.
  const auto still =
      scoreOf({{inCube(0, 0.02F), 9}, {inCube(0, 0.02F), 9}, {inCube(0, -0.02F), 252}}, keptBelow(0.05F));
  EXPECT_EQ(still.cells->still, (Survivors{1, 0}));
  EXPECT_EQ(still.dynamic_cells, 1U);
}

TEST(RhmapProtocol, ACubeOfWhichOnlyIgnoredPointsAreKeptIsNotDynamic) {
  const auto score = scoreOf({{inCube(0, 0.02F), 252}, {inCube(0, -0.02F), 0}}, keptBelow(0.05F));
  EXPECT_EQ(score.cells->moving, (Survivors{1, 0}));
}

TEST(RhmapProtocol, TheClassOfACubeIsItsMostFrequentMovingOne) {
  const auto score =
      scoreOf({{inCube(0), 252}, {inCube(0), 254}, {inCube(0), 254}, {inCube(1), 254}, {inCube(1), 252}}, keptBelow(1));
  EXPECT_EQ(score.cells->classes, (std::map<std::uint16_t, Survivors>{{252, {1, 1}}, {254, {1, 1}}}));
}

TEST(RhmapProtocol, AnEmptyEstimateLosesAndRejectsAll) {
  const auto score = scoreOf({{inCube(0), 9}, {inCube(1), 252}}, keptInCloud("row", {}));
  EXPECT_EQ(score.cells->staticKept(), 0.0);
  EXPECT_EQ(score.cells->dynamicRemoved(), 1.0);
}

TEST(RhmapProtocol, ACloudKeepsTheCubesThatItHits) {
  const auto score =
      scoreOf({{inCube(0), 9}, {inCube(1), 252}, {inCube(-1), 9}}, keptInCloud("row", {inCube(0, 0.04F), inCube(9)}));
  EXPECT_EQ(*score.cells, (Counts{.still = {2, 1}, .moving = {1, 0}, .classes = {{252, {1, 0}}}}));
}

TEST(RhmapProtocol, TheResolutionIsTheCubes) {
  EvaluationConfig config = only("rhmap");
  config.rhmap->resolution = 0.2;
  EXPECT_EQ(test::scoreOf(config, {{inCube(0), 9}, {inCube(1), 9}, {inCube(2), 9}}, keptBelow(1)).cells->still,
            (Survivors{2, 2}));
}

}  // namespace
}  // namespace rhmap::eval::test
