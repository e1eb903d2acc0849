// SPDX-License-Identifier: BSD-3-Clause
#include "range_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "rhmap/sim/lidar.hpp"
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

/// A full turn of each beam [rad], all at 20 m.
ScanPoints turnOf(const std::vector<double>& beams, int shots) {
  octomap::Pointcloud cloud;
  for (const double elevation : beams) {
    for (int j = 0; j < shots; ++j) {
      const double azimuth = (j + 0.5) / shots * 2 * M_PI;
      cloud.push_back(static_cast<float>(20 * std::cos(elevation) * std::cos(azimuth)),
                      static_cast<float>(20 * std::cos(elevation) * std::sin(azimuth)),
                      static_cast<float>(20 * std::sin(elevation)));
    }
  }
  return test::scanOf(cloud);
}

TEST(Projection, HasARowForEachOfBeamsThatAreNotEquallyFarApart) {
  const std::vector<double> beams = sim::elevations(32);
  const Projection p = measureProjection({}, turnOf(beams, 1800));
  EXPECT_EQ(p.rows, 32);
  EXPECT_GT(p.steps(), 100);
  const auto rowAt = [&](double elevation) {
    return p.row.at(static_cast<std::size_t>(p.stepOf(1, 0, static_cast<float>(std::tan(elevation)))));
  };
  for (std::size_t i = 0; i < beams.size(); ++i) EXPECT_EQ(rowAt(beams[i]), i) << beams[i];
  EXPECT_EQ(rowAt(-19 * M_PI / 180), 30);  // between two beams, the nearer one's
  EXPECT_EQ(rowAt(-22 * M_PI / 180), 31);
  EXPECT_TRUE(std::is_sorted(p.row.begin(), p.row.end()));
}

TEST(Projection, HasNoMoreColumnsThanATurnHasShots) {
  const std::vector<double> beams = sim::elevations(16);
  EXPECT_EQ(measureProjection({}, turnOf(beams, 512)).columns, 512);
  EXPECT_EQ(measureProjection({}, turnOf(beams, 2048)).columns, 1024);
  EXPECT_EQ(measureProjection({.columns = 2048}, turnOf(beams, 1800)).columns, 1800);
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
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (image.point(i) < 0) {
      EXPECT_EQ(image.range(i), RangeImage::kEmpty);
      continue;
    }
    ++shown;
    EXPECT_EQ(image.point(i), 1);
    EXPECT_NEAR(image.range(i), 10, 1e-4);
  }
  EXPECT_EQ(shown, 1);
}

TEST(RangeImage, ShowsTheNearestOfManyPointsInEachPixel) {
  std::mt19937 random(15);
  std::normal_distribution<float> normal;
  octomap::Pointcloud cloud;
  for (int i = 0; i < 20000; ++i) cloud.push_back(20 * normal(random), 20 * normal(random), 4 * normal(random));
  const ScanPoints scan = test::scanOf(cloud);
  const Projection p = measureProjection({.rows = 24, .columns = 180, .fov_up = 15, .fov_down = -15}, scan);
  const RangeImage image(p, scan);
  std::map<std::pair<int, int>, std::size_t> nearest;
  for (std::size_t k = 0; k < scan.size(); ++k) {
    const double elevation = std::atan2(scan.z[k], std::hypot(scan.x[k], scan.y[k])) * 180 / kPi;
    const double row = (15 - elevation) / 30 * 23 + 0.5;
    const double column = (std::atan2(scan.y[k], scan.x[k]) / kPi + 1) / 2 * 180;
    if (row < 0 || row >= 24) continue;
    const auto [at, is_new] = nearest.try_emplace({static_cast<int>(row), static_cast<int>(column)}, k);
    if (!is_new && scan.range[k] < scan.range[at->second]) at->second = k;
  }
  std::size_t same = 0;
  for (const auto& [pixel, k] : nearest)
    same += image.pointAt(pixel.first, pixel.second) == static_cast<std::int32_t>(k) &&
            image.at(pixel.first, pixel.second) == scan.range[k];
  EXPECT_GT(nearest.size(), 3000U);
  EXPECT_GT(same, nearest.size() * 99 / 100);  // points on the edge of a pixel may fall into the next
}

TEST(RangeImage, LeavesOutWhatIsAboveOrBelowItsFieldOfView) {
  octomap::Pointcloud cloud;
  cloud.push_back(10, 0, 5);
  cloud.push_back(10, 0, -5);
  const ScanPoints scan = test::scanOf(cloud);
  const RangeImage image(measureProjection({.rows = 16, .columns = 90, .fov_up = 10, .fov_down = -10}, scan), scan);
  for (std::size_t i = 0; i < image.size(); ++i) EXPECT_LT(image.point(i), 0);
}

TEST(RangeImage, MeetsItselfBehindTheSensor) {
  const Projection p = evenProjection(16, 90, 0.2F, -0.2F);
  EXPECT_EQ(p.columnOf(-10, 0.01F), 89);
  EXPECT_EQ(p.columnOf(-10, -0.01F), 0);
  EXPECT_GE(p.columnOf(-10, 0), 0);
  EXPECT_LT(p.columnOf(-10, 0), 90);
  EXPECT_GE(p.columnOf(-10, -0.0F), 0);
}

}  // namespace
}  // namespace rhmap
