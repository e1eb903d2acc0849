// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "memory_scans.hpp"

namespace rhmap::eval::test {
namespace {

Score scoreOf(const std::vector<Labelled>& points, const Estimate& row) {
  return test::scoreOf(only("kth"), points, row);
}

TEST(KthProtocol, EveryLabelledPointCounts) {
  const auto score =
      scoreOf({{{0, 0, 0}, 9}, {{0, 0, 0}, 9}, {{0.5F, 0, 0}, 0}, {{1, 0, 0}, 252}, {{2, 0, 0}, 40}}, keptBelow(0.9F));
  EXPECT_EQ(*score.points, (Counts{.still = {3, 2}, .moving = {1, 0}, .classes = {{252, {1, 0}}}}));
  EXPECT_FALSE(score.cells);
}

TEST(KthProtocol, ARemovedPointNearAKeptOneCountsAsKept) {
  // 0.03125 and 0.0625 are exact in binary: the first is within 0.05 m, the other is not.
  const auto near = scoreOf({{{0, 0, 0}, 9}, {{0.03125F, 0, 0}, 252}}, keptBelow(0.01F));
  EXPECT_EQ(near.points->moving, (Survivors{1, 1}));
  const auto far = scoreOf({{{0, 0, 0}, 9}, {{0.0625F, 0, 0}, 252}}, keptBelow(0.01F));
  EXPECT_EQ(far.points->moving, (Survivors{1, 0}));
}

TEST(KthProtocol, TheToleranceItselfIsNear) {
  EvaluationConfig config = only("kth");
  config.kth->tolerance = 0.0625;
  EXPECT_EQ(test::scoreOf(config, {{{0, 0, 0}, 9}, {{0.0625F, 0, 0}, 252}}, keptBelow(0.01F)).points->moving,
            (Survivors{1, 1}));
}

TEST(KthProtocol, AnIgnoredPointThatIsKeptIsInTheMapToo) {
  EXPECT_EQ(scoreOf({{{0, 0, 0}, 0}, {{0.03F, 0, 0}, 252}}, keptBelow(0.01F)).points->moving, (Survivors{1, 1}));
}

TEST(KthProtocol, APointIsKeptByAnotherScansPoint) {
  const Estimate row = keptBelow(0.01F);
  const auto scores = evaluate(MemoryScans({{{{0.03F, 0, 0}, 252}}, {{{0, 0, 0}, 9}}}), only("kth"), {&row, 1});
  EXPECT_EQ(test::scoreOf(scores, "row").points->moving, (Survivors{1, 1}));
}

TEST(KthProtocol, ACloudIsTakenAsItIs) {
  const auto score = scoreOf({{{0, 0, 0}, 9}, {{1, 0, 0}, 252}, {{2, 0, 0}, 252}},
                             keptInCloud("row", {{0, 0.04F, 0}, {1, 0.06F, 0}, {2, 0, 0.02F}}));
  EXPECT_EQ(*score.points, (Counts{.still = {1, 1}, .moving = {2, 1}, .classes = {{252, {2, 1}}}}));
}

TEST(KthProtocol, LabelsFromTheMaximumRangeOnAreNotTrusted) {
  EXPECT_EQ(scoreOf({{{49.9F, 0, 0}, 9}, {{50, 0, 0}, 9}, {{0, 60, 0}, 252}}, keptBelow(99)).points,
            (Counts{.still = {1, 1}, .moving = {}, .classes = {}}));
}

TEST(KthProtocol, TheVehicleItselfMovesIfAsked) {
  const std::vector<Labelled> points{{{1, 0, 0}, 0}, {{2, 0, 0}, 1}, {{2, 1, 0}, 9}, {{3, 0, 0}, 0}, {{4, 0, 0}, 1}};
  EvaluationConfig config = only("kth");
  config.kth->ego_radius = 3;
  EXPECT_EQ(test::scoreOf(config, points, keptBelow(9)).points,
            (Counts{.still = {2, 2}, .moving = {2, 2}, .classes = {{252, {2, 2}}}}));
  EXPECT_EQ(scoreOf(points, keptBelow(9)).points, (Counts{.still = {3, 3}, .moving = {}, .classes = {}}));
}

}  // namespace
}  // namespace rhmap::eval::test
