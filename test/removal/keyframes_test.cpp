// SPDX-License-Identifier: BSD-3-Clause
#include "keyframes.hpp"

#include <gtest/gtest.h>

#include "small_world.hpp"

namespace rhmap {
namespace {

ScanContext contextAt(int x) {
  return {{}, {}, SensorView(KeySpace(test::kCube), octomap::pose6d(static_cast<float>(x), 0, 0, 0, 0, 0)), nullptr};
}

TEST(InformationContent, IsTheShareOfTheCircleThatIsSeen) {  // Eq. (14)
  octomap::Pointcloud cloud;
  for (int j = 0; j < 45; ++j) {  // half of 90 columns see up to 40 m and, nearer, up to 10 m
    const double azimuth = (j + 0.5) * 2 * 3.14159265 / 90;
    for (const double range : {10.0, 40.0})
      cloud.push_back(static_cast<float>(range * std::cos(azimuth)), static_cast<float>(range * std::sin(azimuth)),
                      range < 20 ? -1.0F : 4.0F);
  }
  const ScanPoints scan = test::scanOf(cloud);
  const RangeImage image(measureProjection({.rows = 32, .columns = 90, .fov_up = 20, .fov_down = -20}, scan), scan);
  EXPECT_NEAR(informationContent(image, 80), 25, 0.2);
  EXPECT_NEAR(informationContent(image, 20), 50, 0.1);  // no farther than r_max
}

TEST(Keyframes, ComeByDistanceTimeOrInformation) {
  Keyframes keyframes({.distance = 2, .scans = 10, .information = 5});
  EXPECT_TRUE(keyframes.wants({0, 0, 0}, 1, 50));
  EXPECT_FALSE(keyframes.wants({1.9F, 0, 0}, 2, 50));
  EXPECT_TRUE(keyframes.wants({0, 2, 0}, 3, 50));
  EXPECT_FALSE(keyframes.wants({0, 2, 0}, 12, 54));
  EXPECT_TRUE(keyframes.wants({0, 2, 0}, 13, 54));
  EXPECT_TRUE(keyframes.wants({0, 2, 0}, 14, 49));
}

TEST(Keyframes, WaitUntilTheSensorIsFarOrTooManyWait) {
  Keyframes keyframes({.delay = 20, .max_queue = 3});
  for (int x = 0; x < 3; ++x) keyframes.push({static_cast<float>(x), 0, 0}, contextAt(x));
  EXPECT_FALSE(keyframes.pop({19.9F, 0, 0}));
  EXPECT_TRUE(keyframes.pop({20, 0, 0}));
  EXPECT_FALSE(keyframes.pop({20.5F, 0, 0}));
  for (int x = 3; x < 5; ++x) keyframes.push({static_cast<float>(x), 0, 0}, contextAt(x));
  EXPECT_TRUE(keyframes.pop({4, 0, 0}));  // four wait
  EXPECT_FALSE(keyframes.pop({4, 0, 0}));
  const auto last = [&] {
    std::optional<ScanContext> context, next;
    while ((next = keyframes.pop())) context = next;
    return context;
  }();
  ASSERT_TRUE(last);
  EXPECT_FLOAT_EQ(last->view.origin()[0], contextAt(4).view.origin()[0]);
}

}  // namespace
}  // namespace rhmap
