// SPDX-License-Identifier: BSD-3-Clause
#include "range_image.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "small_world.hpp"

namespace rhmap {
namespace {

TEST(FastAtan2, IsWithin2e5OfTheRealOne) {
  for (int i = -2000; i <= 2000; ++i) {
    const float angle = static_cast<float>(i) / 2000 * 3.14159F;
    for (const float r : {1e-3F, 1.0F, 80.0F}) {
      const float y = r * std::sin(angle), x = r * std::cos(angle);
      ASSERT_NEAR(fastAtan2(y, x), std::atan2(y, x), 2e-5) << angle;
    }
  }
  EXPECT_EQ(fastAtan2(0, 0), 0);
}

class Beams : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Numbers, Beams, testing::Values(16, 32, 64, 128));

TEST_P(Beams, AreCountedInTheScan) {
  const ScanPoints scan = test::scanOf(test::wallAndGround(20, GetParam(), 1800));
  const Projection p = measureProjection({}, scan);
  EXPECT_NEAR(p.bottom * 180 / 3.14159, -20, 1);
  EXPECT_NEAR(p.top * 180 / 3.14159, 10, 1);
  EXPECT_NEAR(p.rows, GetParam(), 2);
}

TEST(Projection, IsWhatTheConfigurationSays) {
  const Projection p = measureProjection({.rows = 40, .columns = 500, .fov_up = 5, .fov_down = -15}, ScanPoints{});
  EXPECT_EQ(p.rows, 40);
  EXPECT_EQ(p.columns, 500);
  EXPECT_NEAR(p.top, 5 * 3.14159 / 180, 1e-4);
}

TEST(RangeImage, ShowsTheNearestPointOfAPixel) {
  octomap::Pointcloud cloud;
  cloud.push_back(20, 0.01F, 0);
  cloud.push_back(10, 0.005F, 0);
  cloud.push_back(15, 0.008F, 0);
  const ScanPoints scan = test::scanOf(cloud);
  const RangeImage image(measureProjection({.rows = 16, .columns = 90, .fov_up = 10, .fov_down = -10}, scan), scan);
  int shown = 0;
  for (std::size_t i = 0; i < image.ranges().size(); ++i) {
    if (image.points()[i] < 0) {
      EXPECT_EQ(image.ranges()[i], RangeImage::kEmpty);
      continue;
    }
    ++shown;
    EXPECT_EQ(image.points()[i], 1);
    EXPECT_NEAR(image.ranges()[i], 10, 1e-4);
  }
  EXPECT_EQ(shown, 1);
}

}  // namespace
}  // namespace rhmap
