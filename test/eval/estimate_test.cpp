// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/eval/estimate.hpp"

#include <gtest/gtest.h>

#include "memory_scans.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap::eval::test {
namespace {

const LabelledScan kScan = labelledScan({{{1, 0, 0}, 9}, {{2, 0, 0}, 252}, {{3, 0, 0}, 0}});

TEST(Estimate, NoRemovalKeepsAll) { EXPECT_EQ(noRemoval().keep(kScan), (KeptMask{1, 1, 1})); }

TEST(Estimate, TheOracleLeavesOutExactlyWhatMoves) { EXPECT_EQ(oracle(Labels()).keep(kScan), (KeptMask{1, 0, 1})); }

TEST(Estimate, AMapKeepsPointsWhereItIsOccupied) {
  OcTree tree(0.1);
  tree.updateNode(octomap::point3d(1, 0, 0), true);
  tree.updateNode(octomap::point3d(2, 0, 0), false);
  EXPECT_EQ(keptInMap("map", tree).keep(kScan), (KeptMask{1, 0, 0}));
}

TEST(LabelledScan, IsInTheWorldAndCutByTheDistanceToTheSensor) {
  MemoryScans scans({{{{1, 0, 0}, 9}, {{2, 0, 0}, 252}, {{3, 0, 0}, 9}, {{4, 0, 0}, 9}}});
  scans.scans()[0].pose = octomap::pose6d(100, 0, 0, 0, 0, 0);
  const LabelledScan scan = readLabelledScan(scans, 0, {.min_range = 2, .max_range = 3});
  ASSERT_EQ(scan.points.size(), 2U);
  EXPECT_EQ(scan.points[0], octomap::point3d(102, 0, 0));
  EXPECT_EQ(scan.in_sensor[0], octomap::point3d(2, 0, 0));
  EXPECT_EQ(scan.labels, (std::vector<std::uint32_t>{252, 9}));
}

TEST(LabelledScan, WithoutLabelsIsAnErrorThatNamesTheScan) {
  MemoryScans scans({{{{1, 0, 0}, 9}}});
  scans.scans()[0].labels.clear();
  EXPECT_THROW(readLabelledScan(scans, 0, {}), std::runtime_error);
}

}  // namespace
}  // namespace rhmap::eval::test
