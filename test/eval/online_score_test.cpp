// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/eval/online_score.hpp"

#include <gtest/gtest.h>

#include "memory_scans.hpp"

namespace rhmap::eval::test {
namespace {

Estimate mapThat(bool keeps) {
  return keptBy("map", [keeps](const octomap::point3d&) { return keeps; });
}

TEST(OnlineScore, JudgesEachScanAtOnceAndAgainAfterTheLag) {
  OnlineScore online(Labels(), 2);
  const LabelledScan scan = labelledScan({{{0, 0, 0}, 9}, {{1, 0, 0}, 252}, {{2, 0, 0}, 0}});
  online.add(scan, mapThat(true));
  online.add(scan, mapThat(true));
  EXPECT_EQ(online.atOnce(), (Counts{.still = {2, 2}, .moving = {2, 2}, .classes = {{252, {2, 2}}}}));
  EXPECT_EQ(online.later(), Counts{});
  online.add(scan, mapThat(false));  // now the first scan is two scans old
  EXPECT_EQ(online.atOnce(), (Counts{.still = {3, 2}, .moving = {3, 2}, .classes = {{252, {3, 2}}}}));
  EXPECT_EQ(online.later(), (Counts{.still = {1, 0}, .moving = {1, 0}, .classes = {{252, {1, 0}}}}));
}

TEST(OnlineScore, AsksTheLaterMapForTheEarlierScansPoints) {
  OnlineScore online(Labels(), 1);
  online.add(labelledScan({{{0, 0, 0}, 9}}), keptBelow(1));
  online.add(labelledScan({{{5, 0, 0}, 9}}), keptBelow(1));
  EXPECT_EQ(online.atOnce().still, (Survivors{2, 1}));
  EXPECT_EQ(online.later().still, (Survivors{1, 1}));
}

TEST(OnlineScore, RefusesALagOf0AndClouds) {
  EXPECT_THROW(OnlineScore(Labels(), 0), std::invalid_argument);
  OnlineScore online{Labels()};
  EXPECT_THROW(online.add(labelledScan({}), keptInCloud("cloud", {})), std::invalid_argument);
}

}  // namespace
}  // namespace rhmap::eval::test
