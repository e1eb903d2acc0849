// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/lidar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "surface.hpp"

namespace rhmap::sim::test {
namespace {

using Eigen::Vector3d;

const LidarConfig kExact{.beams = 16, .max_range = 60, .range_noise = 0, .drop_out = 0};

/// All shapes, turned and partly one behind the other, on the plane and about the sensor's axis.
Scene clutter() {
  Scene scene;
  scene.terrain.addPatch({{0, 0}, {20, 3}, 0.3, kRoad});
  Random random(11, 0);
  const auto add = [&](Shape shape, double x, double y, double z) {
    Object object{.parts = {{shape, {0.3, -0.2, z}, random.uniform(-3, 3)}}, .resting = kOtherObject};
    object.track = Track(Stance{{x, y, 0}, random.uniform(-3, 3)});
    object.instance = static_cast<std::uint16_t>(scene.objects.size() + 1);
    scene.objects.push_back(object);
  };
  for (int i = 0; i < 12; ++i) {
    const double x = random.uniform(4, 30) * (i % 2 == 0 ? 1 : -1), y = random.uniform(-30, 30);
    add(Box{{2, 1, 1.5}}, x, y, 1.5);
    add(Cylinder{0.5, 2}, y, x, 2);
    add(Capsule{0.3, 0.6}, x / 2, y / 2 + 3, 0.9);
    add(Ellipsoid{{2, 2, 1.5}}, -x, -y, 4);
  }
  add(Box{{50, 50, 0.1}}, 0, 0, 9);  // above: seen under all azimuths
  return scene;
}

std::vector<std::uint32_t> labelsOf(const Scene& scene) {
  std::vector<std::uint32_t> labels;
  for (const Object& object : scene.objects) labels.push_back(toLabel(object.resting, object.instance));
  return labels;
}

TEST(Lidar, HasItsBeamsFromTheTopDown) {
  for (const int beams : lidarModels()) {
    const auto angles = elevations(beams);
    ASSERT_EQ(angles.size(), static_cast<std::size_t>(beams));
    for (std::size_t i = 1; i < angles.size(); ++i) EXPECT_LT(angles[i], angles[i - 1]);
  }
  const double degree = std::numbers::pi / 180;
  EXPECT_DOUBLE_EQ(elevations(64).front(), 2 * degree);
  EXPECT_DOUBLE_EQ(elevations(64).back(), -24.8 * degree);
  EXPECT_THROW(elevations(17), std::invalid_argument);
}

TEST(Lidar, RefusesWhatIsNoLidar) {
  for (const LidarConfig& config :
       {LidarConfig{.beams = 20}, LidarConfig{.azimuth_step = 0.7}, LidarConfig{.azimuth_step = 0},
        LidarConfig{.max_range = 0}, LidarConfig{.range_noise = -1}, LidarConfig{.drop_out = 1.1}})
    EXPECT_THROW(validate(config), std::invalid_argument);
  EXPECT_NO_THROW(validate({}));
}

TEST(Lidar, SeesTheGroundAroundItInCircles) {
  Scene scene;
  const LidarScan scan = scanScene(scene, 0, kExact, {}, Random(1, 1));
  ASSERT_EQ(scan.points.size(), 1800u * 7) << "7 of 16 beams come down within 60 m";
  for (const auto& point : scan.points) EXPECT_NEAR(point[2], -1.73, 1e-5);
  EXPECT_NEAR(std::hypot(scan.points.back()[0], scan.points.back()[1]), 1.73 / std::tan(std::numbers::pi / 12), 1e-4);
}

/// Culling by azimuth and distance changes nothing: every beam against every part.
TEST(Lidar, SeesWhatABeamAgainstAllObjectsSees) {
  const Scene scene = clutter();
  const LidarConfig config{
      .beams = 32, .max_range = 60, .range_noise = 0, .drop_out = 0, .no_returns = NoReturns::kZero};
  const LidarScan scan = scanScene(scene, 0, config, labelsOf(scene), Random(1, 1));
  const auto angles = elevations(32);
  ASSERT_EQ(scan.points.size(), 1800u * 32);
  const Vector3d origin = scene.sensorPose(0).translation();
  for (std::size_t i = 0; i < scan.points.size(); i += 7) {
    const double elevation = angles[i / 1800], azimuth = 2 * std::numbers::pi * static_cast<double>(i % 1800) / 1800;
    const Vector3d direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                             std::sin(elevation));
    double range = scene.terrain.hitDistance(origin, direction, 60);
    std::uint32_t label = kUnlabelled;
    if (range != kNoHit) label = scene.terrain.classAt(range * direction.x(), range * direction.y());
    for (const Object& object : scene.objects) {
      const Part& part = object.parts.front();
      const Eigen::Isometry3d inverse = (scene.objectPose(object, 0) * Eigen::Translation3d(part.centre) *
                                         Eigen::AngleAxisd(part.yaw, Vector3d::UnitZ()))
                                            .inverse();
      const double hit = hitDistance(part.shape, inverse * origin, inverse.linear() * direction);
      if (hit < range && hit <= 60) {
        range = hit;
        label = toLabel(object.resting, object.instance);
      }
    }
    const auto& point = scan.points[i];
    ASSERT_EQ(scan.labels[i], label) << i;
    ASSERT_NEAR(Vector3d(point[0], point[1], point[2]).norm(), range == kNoHit ? 0 : range, 1e-4) << i;
  }
}

TEST(Lidar, NoiseAndDropOutsAreAsBigAsTheySay) {
  const Scene scene;
  LidarConfig config = kExact;
  config.range_noise = 0.05;
  config.drop_out = 0.25;
  config.no_returns = NoReturns::kZero;
  const LidarScan exact = scanScene(
      scene, 0, {.beams = 16, .max_range = 60, .range_noise = 0, .drop_out = 0, .no_returns = NoReturns::kZero}, {},
      Random(1, 1));
  const LidarScan noisy = scanScene(scene, 0, config, {}, Random(1, 1));
  ASSERT_EQ(noisy.points.size(), exact.points.size());
  double sum = 0, squares = 0, seen = 0, lost = 0;
  for (std::size_t i = 0; i < exact.points.size(); ++i) {
    const auto range = [](const auto& p) {
      return std::sqrt(double{p[0]} * p[0] + double{p[1]} * p[1] + double{p[2]} * p[2]);
    };
    if (range(exact.points[i]) == 0) continue;
    if (range(noisy.points[i]) == 0) {
      ++lost;
      EXPECT_EQ(noisy.labels[i], 0u);
      continue;
    }
    const double error = range(noisy.points[i]) - range(exact.points[i]);
    ++seen;
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(lost / (lost + seen), 0.25, 0.02);
  EXPECT_NEAR(sum / seen, 0, 0.003);
  EXPECT_NEAR(std::sqrt(squares / seen), 0.05, 0.003);
}

}  // namespace
}  // namespace rhmap::sim::test
