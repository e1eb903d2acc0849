// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "memory_scans.hpp"
#include "voxelize.hpp"

namespace rhmap::eval::test {
namespace {

Score scoreOf(const std::vector<Labelled>& points, const Estimate& row) {
  return test::scoreOf(only("erasor"), points, row);
}

TEST(Voxelize, ACentroidHasTheLabelOfItsNearestPointNotOfTheMajority) {
  const LabelledCloud cloud{.points = {{0.02F, 0.1F, 0.1F}, {0.18F, 0.1F, 0.1F}, {0.09F, 0.1F, 0.1F}},
                            .labels = {9, 9, 252}};
  const LabelledCloud voxels = voxelizePreservingLabels(cloud, 0.2);
  ASSERT_EQ(voxels.points.size(), 1U);
  EXPECT_NEAR(voxels.points[0].x(), 0.29 / 3, 1e-6);
  EXPECT_EQ(voxels.labels[0], 252U);
}

TEST(Voxelize, TheNearestPointMayLieInTheNextVoxel) {
  // The first voxel's centroid is (0.19, 0.1): its own points are 0.09 m away, the neighbour's only 0.02.
  const LabelledCloud cloud{.points = {{0.19F, 0.01F, 0.1F}, {0.19F, 0.19F, 0.1F}, {0.21F, 0.1F, 0.1F}},
                            .labels = {9, 9, 252}};
  const LabelledCloud voxels = voxelizePreservingLabels(cloud, 0.2);
  ASSERT_EQ(voxels.points.size(), 2U);
  EXPECT_EQ(voxels.labels[0], 252U);
}

TEST(ErasorProtocol, WhatIsGoneIsGone) {
  const auto score =
      scoreOf({{{0.1F, 0.1F, 0.1F}, 9}, {{1.1F, 0.1F, 0.1F}, 40}, {{2.1F, 0.1F, 0.1F}, 253}}, keptBelow(1));
  EXPECT_EQ(*score.cells, (Counts{.still = {2, 1}, .moving = {1, 0}, .classes = {{253, {1, 0}}}}));
  EXPECT_FALSE(score.points);
}

TEST(ErasorProtocol, AMovingVoxelWhoseNearestSurvivorIsStaticIsRejected) {
  const auto score = scoreOf({{{0.19F, 0.1F, 0.1F}, 252}, {{0.21F, 0.1F, 0.1F}, 9}},
                             keptBy("row", [](const octomap::point3d& point) { return point.x() > 0.2F; }));
  EXPECT_EQ(score.cells->moving, (Survivors{1, 0}));
  EXPECT_EQ(score.cells->still, (Survivors{1, 1}));
}

TEST(ErasorProtocol, AStaticVoxelWhoseNearestSurvivorMovesIsLost) {
  const auto score = scoreOf({{{0.19F, 0.1F, 0.1F}, 9}, {{0.21F, 0.1F, 0.1F}, 252}},
                             keptBy("row", [](const octomap::point3d& point) { return point.x() > 0.2F; }));
  EXPECT_EQ(score.cells->still, (Survivors{1, 0}));
  EXPECT_EQ(score.cells->moving, (Survivors{1, 1}));
}

TEST(ErasorProtocol, SurvivorsCountWithinHalfADiagonalOnly) {
  const std::vector<Labelled> points{{{0.1F, 0.1F, 0.1F}, 9}};
  EXPECT_EQ(scoreOf(points, keptInCloud("row", {{0.27F, 0.1F, 0.1F}})).cells->still, (Survivors{1, 1}));
  EXPECT_EQ(scoreOf(points, keptInCloud("row", {{0.28F, 0.1F, 0.1F}})).cells->still, (Survivors{1, 0}));
}

TEST(ErasorProtocol, ACloudTakesItsLabelsFromTheMapAroundIt) {
  const auto score = scoreOf({{{0.1F, 0.1F, 0.1F}, 9}, {{1.1F, 0.1F, 0.1F}, 252}, {{2.1F, 0.1F, 0.1F}, 252}},
                             keptInCloud("row", {{0.15F, 0.1F, 0.1F}, {1.15F, 0.1F, 0.1F}, {50, 0, 0}}));
  EXPECT_EQ(*score.cells, (Counts{.still = {1, 1}, .moving = {2, 1}, .classes = {{252, {2, 1}}}}));
  EXPECT_EQ(score.static_cells, 2U);
  EXPECT_EQ(score.dynamic_cells, 1U);
}

TEST(ErasorProtocol, IgnoredVoxelsAreNotCounted) {
  EXPECT_EQ(*scoreOf({{{0.1F, 0.1F, 0.1F}, 0}}, keptBelow(1)).cells, Counts{});
}

TEST(ErasorProtocol, TheVehicleIsDroppedByItsHorizontalDistance) {
  EvaluationConfig config = only("erasor");
  config.erasor->ego_radius = 2.7;
  const auto score = test::scoreOf(config, {{{2.6F, 0, 1}, 9}, {{2.6F, 0, -2}, 252}, {{2.8F, 0, 0}, 9}}, keptBelow(9));
  EXPECT_EQ(*score.cells, (Counts{.still = {1, 1}, .moving = {}, .classes = {}}));
}

TEST(ErasorProtocol, AnEmptyEstimateLosesAndRejectsAll) {
  const auto score = scoreOf({{{0.1F, 0.1F, 0.1F}, 9}, {{1.1F, 0.1F, 0.1F}, 252}}, keptBelow(-9));
  EXPECT_EQ(score.cells->staticKept(), 0.0);
  EXPECT_EQ(score.cells->dynamicRemoved(), 1.0);
}

}  // namespace
}  // namespace rhmap::eval::test
