// SPDX-License-Identifier: BSD-3-Clause
// The labelled KITTI clip: baselines as the protocols promise them, and the counts of labels as counted one by one.
#include <gtest/gtest.h>

#include "../clip.hpp"
#include "memory_scans.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap::eval::test {
namespace {

struct ClipTest : testing::Test {
  std::unique_ptr<io::ScanSequence> clip = io::openSequence(rhmap::test::clipFolder());
};

TEST_F(ClipTest, BaselinesAreWhatTheProtocolsPromise) {
  EvaluationConfig config;
  config.window.min_range = 0.5;
  const auto scores = evaluate(*clip, config);
  ASSERT_EQ(scores.size(), 6U);
  const Counts& cubes = *scores[0].cells;
  EXPECT_EQ(cubes.staticKept(), 1.0);
  EXPECT_EQ(cubes.dynamicRemoved(), 0.0);
  EXPECT_EQ(scores[1].cells->staticKept(), 1.0);
  EXPECT_EQ(scores[1].cells->dynamicRemoved(), 1.0);
  EXPECT_EQ(scores[1].points->staticKept(), 1.0);

  // ERASOR's ground truth is voxelised twice, an estimate once: nearly 100 and 0.
  EXPECT_GT(*scores[2].cells->staticKept(), 0.999);
  EXPECT_LT(*scores[2].cells->dynamicRemoved(), 0.005);
  EXPECT_GT(*scores[3].cells->staticKept(), 0.9999);
  EXPECT_EQ(scores[3].cells->dynamicRemoved(), 1.0);

  // A few moving points are within 5 cm of what stands.
  EXPECT_EQ(scores[4].points->staticKept(), 1.0);
  EXPECT_EQ(scores[4].points->dynamicRemoved(), 0.0);
  EXPECT_EQ(scores[5].points->staticKept(), 1.0);
  EXPECT_GT(*scores[5].points->dynamicRemoved(), 0.95);
  EXPECT_LT(*scores[5].points->dynamicRemoved(), 1.0);
}

TEST_F(ClipTest, ThePointsAreThoseOfTheLabels) {
  Counts expected;
  std::size_t beyond_50 = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    const io::Scan scan = clip->scan(i);
    for (std::size_t k = 0; k < scan.labels.size(); ++k) {
      expected.add(Labels(), scan.labels[k], true);
      if (scan.points[k].norm() >= 50 && Labels().kind(scan.labels[k]) != Kind::kIgnored) ++beyond_50;
    }
  }
  EvaluationConfig config;
  config.window.last = 4;
  config.erasor.reset();
  const auto scores = evaluate(*clip, config);
  EXPECT_EQ(*scores[0].points, expected);
  EXPECT_EQ(scores[2].points->still.total + scores[2].points->moving.total + beyond_50,
            expected.still.total + expected.moving.total);
}

TEST_F(ClipTest, AMapOfTheScansKeepsWhatItsHitsSay) {
  // Only hits, so nothing that was seen is free: the map's row is `no removal`, whatever the map's resolution.
  for (const double resolution : {0.05, 0.1, 0.2}) {
    OcTree tree(resolution);
    for (std::size_t i = 0; i < 3; ++i) {
      for (const octomap::point3d& point : readLabelledScan(*clip, i, {}).points) tree.updateNode(point, true);
    }
    EvaluationConfig config;
    config.window.last = 2;
    const Estimate row = keptInMap("map", tree);
    const auto scores = evaluate(*clip, config, {&row, 1});
    for (std::size_t k = 0; k < scores.size(); k += 3) {
      EXPECT_EQ(scores[k].cells, scores[k + 2].cells) << scores[k].protocol;
      EXPECT_EQ(scores[k].points, scores[k + 2].points) << scores[k].protocol;
    }
  }
}

}  // namespace
}  // namespace rhmap::eval::test
