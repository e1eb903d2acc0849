// SPDX-License-Identifier: BSD-3-Clause
#include "scan_points.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace rhmap {
namespace {

TEST(ScanPoints, FindTheCubesThatOctomapsTransformationFinds) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  const KeySpace keys(0.1);
  for (int round = 0; round < 20; ++round) {
    const octomap::pose6d pose(100 * normal(random), 100 * normal(random), normal(random), normal(random),
                               normal(random), normal(random));
    octomap::Pointcloud cloud;
    for (int i = 0; i < 1000; ++i) cloud.push_back(30 * normal(random), 30 * normal(random), 3 * normal(random));
    ScanPoints scan;
    locatePoints(keys, cloud, pose, 0, -1, scan);
    ASSERT_EQ(scan.size(), cloud.size());
    octomap::Pointcloud world(cloud);
    world.transform(pose);
    for (unsigned i = 0; i < cloud.size(); ++i) {
      OcTreeKey key;
      ASSERT_TRUE(keys.coordToKeyChecked(world[i], key));
      ASSERT_EQ(scan.cubeAt(i), key);
    }
  }
}

TEST(ScanPoints, LeaveOutWhatIsNotFiniteTooNearTooFarOrOutside) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  octomap::Pointcloud cloud;
  cloud.push_back(kNan, 1, 1);
  cloud.push_back(5, kInf, 1);
  cloud.push_back(1, 0, 0);   // nearer than 2 m
  cloud.push_back(0, 60, 0);  // farther than 50 m
  cloud.push_back(10, 0, 0);
  ScanPoints scan;
  locatePoints(KeySpace(0.1), cloud, octomap::pose6d(), 2, 50, scan);
  EXPECT_EQ(scan.given, 5U);
  EXPECT_EQ(scan.dropped, 4U);
  ASSERT_EQ(scan.size(), 1U);
  EXPECT_FLOAT_EQ(scan.range[0], 10);
  locatePoints(KeySpace(0.1), cloud, octomap::pose6d(1e6F, 0, 0, 0, 0, 0), 2, 50, scan);
  EXPECT_EQ(scan.size(), 0U);
}

}  // namespace
}  // namespace rhmap
