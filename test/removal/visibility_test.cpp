// SPDX-License-Identifier: BSD-3-Clause
#include "visibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "small_world.hpp"

namespace rhmap {
namespace {

using test::kCube;

Visibility visibilityOf(const octomap::Pointcloud& cloud, const VisibilityConfig& config = {}) {
  const ScanPoints scan = test::scanOf(cloud);
  return Visibility(RangeImage(measureProjection({}, scan), scan), scan, config, kCube);
}

TEST(SensorView, IsTheInverseOfThePose) {
  const KeySpace keys(kCube);
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 200; ++i) {
    const octomap::pose6d pose(20 * normal(random), 20 * normal(random), normal(random), normal(random), normal(random),
                               normal(random));
    const SensorView view(keys, pose);
    const OcTreeKey cube(static_cast<key_type>(kTreeMaxVal + 100 + i), static_cast<key_type>(kTreeMaxVal - i),
                         kTreeMaxVal);
    const auto seen = view(cube[0], cube[1], cube[2]);
    const octomap::point3d expected = pose.inv().transform(keys.keyToCoord(cube));
    EXPECT_NEAR(seen[0], expected.x(), 5e-3);
    EXPECT_NEAR(seen[1], expected.y(), 5e-3);
    EXPECT_NEAR(seen[2], expected.z(), 5e-3);
  }
}

TEST(Visibility, SeesThroughWhatIsBeforeAWallAndNotWhatIsInOrBehindIt) {
  const Visibility visibility = visibilityOf(test::wallAndGround(20));
  EXPECT_EQ(visibility.at({15, 0, 0}), Look::kSeenThrough);
  EXPECT_EQ(visibility.at({19.9F, 0, 0}), Look::kFilled);
  EXPECT_EQ(visibility.at({25, 0, 0}), Look::kUnknown);
  EXPECT_EQ(visibility.at({5, 0, 5}), Look::kUnknown);       // above the field of view
  EXPECT_EQ(visibility.at({-10, 0, 0.5F}), Look::kUnknown);  // where nothing came back
}

TEST(Visibility, NeverSeesThroughLevelGround) {
  const Visibility visibility = visibilityOf(test::wallAndGround(60));
  for (const float z : {-1.65F, -1.75F})  // the cubes at the ground's 1.7 m
    for (int x = -500; x <= 500; x += 3)
      for (int y = -200; y <= 200; y += 7)
        EXPECT_NE(visibility.at({static_cast<float>(x) / 10, static_cast<float>(y) / 10, z}), Look::kSeenThrough)
            << x << ' ' << y << ' ' << z;
  EXPECT_EQ(visibility.at({10, 0, -1}), Look::kSeenThrough);
}

TEST(Visibility, WithNothingAroundAPlaceItCannotTell) {
  octomap::Pointcloud cloud;
  cloud.push_back(20, 0, 0);
  EXPECT_EQ(visibilityOf(cloud).at({0, 10, 0}), Look::kUnknown);
}

TEST(Visibility, DoesNotSeeThroughTheEdgeOfAPost) {
  octomap::Pointcloud cloud = test::wallAndGround(20, 64, 1440);
  for (octomap::point3d& p : cloud)  // a post of 0.4 m, 6 m away
    if (p.x() > 6 && std::abs(p.y() / p.x() * 6) < 0.2F) p *= 6 / p.x();
  const Visibility visibility = visibilityOf(cloud);
  for (int y = -25; y <= 25; ++y)
    EXPECT_NE(visibility.at({6, static_cast<float>(y) / 100, 0}), Look::kSeenThrough) << y;
  for (int y = -15; y <= 15; ++y) EXPECT_EQ(visibility.at({8, static_cast<float>(y) / 100, 0}), Look::kUnknown) << y;
  EXPECT_EQ(visibility.at({6, 1, 0}), Look::kSeenThrough);
  EXPECT_EQ(visibility.at({6, -1, 0}), Look::kSeenThrough);
  EXPECT_EQ(visibility.at({4, 0, 0}), Look::kSeenThrough);  // before it
}

TEST(Visibility, DoesNotSeeThroughACeilingThatOnlyTheFirstRowSees) {
  octomap::Pointcloud cloud;
  for (int row = 0; row < 64; ++row) {
    for (int column = 0; column < 1024; ++column) {
      const double elevation = (2 - 0.4 * row) * M_PI / 180, azimuth = (column + 0.5) / 1024 * 2 * M_PI;
      const double ceiling = elevation > 0 ? 1.07 / std::sin(elevation) : 1e9,
                   floor = elevation < 0 ? -1.7 / std::sin(elevation) : 1e9;
      const double range = std::min({ceiling, floor, 60.0});
      cloud.push_back(static_cast<float>(range * std::cos(elevation) * std::cos(azimuth)),
                      static_cast<float>(range * std::cos(elevation) * std::sin(azimuth)),
                      static_cast<float>(range * std::sin(elevation)));
    }
  }
  VisibilityConfig config;
  const Visibility visibility = visibilityOf(cloud, config);
  config.edge_share = 0;
  const Visibility without = visibilityOf(cloud, config);
  int through = 0;
  for (int x = 270; x < 310; ++x) {
    const std::array<float, 3> place{static_cast<float>(x) / 10, 0, 1.05F};
    EXPECT_NE(visibility.at(place), Look::kSeenThrough) << x;
    through += without.at(place) == Look::kSeenThrough;
  }
  EXPECT_GT(through, 5);
  EXPECT_EQ(visibility.at({15, 0, 0.53F}), Look::kSeenThrough);  // far before it
}

TEST(Visibility, SeesOfNearCubesAllThatTheirBallCovers) {
  octomap::Pointcloud cloud = test::wallAndGround(20, 64, 1440);
  for (octomap::point3d& p : cloud) {  // a thin bar 3 m away, in one row
    const double elevation = std::atan2(p.z(), std::hypot(p.x(), p.y())) * 180 / M_PI;
    if (p.x() > 3 && std::abs(elevation - 0.476) < 0.1) p *= 3 / p.x();
  }
  const Visibility visibility = visibilityOf(cloud);
  for (const float below : {0.02F, 0.05F, 0.07F}) {  // 1 to 3 rows
    EXPECT_EQ(visibility.at({3, 0, 0.025F - below}), Look::kFilled) << below;
    EXPECT_EQ(visibility.at({3, 0, 0.025F + below}), Look::kFilled) << below;
  }
  EXPECT_EQ(visibility.at({3, 0, 0.3F}), Look::kSeenThrough);
}

TEST(Visibility, KnowsNothingOfWhatIsFarFromAllRays) {
  const octomap::Pointcloud cloud = test::wallAndGround(20, 16, 1024);  // beams every 2 degrees
  const auto at = [](double x, double degrees) {
    return std::array<float, 3>{static_cast<float>(x), 0, static_cast<float>(x * std::tan(degrees * M_PI / 180))};
  };
  const Visibility visibility = visibilityOf(cloud);
  EXPECT_EQ(visibility.at(at(15, 4)), Look::kSeenThrough);
  EXPECT_EQ(visibility.at(at(15, 4.6)), Look::kSeenThrough);
  EXPECT_EQ(visibility.at(at(15, 5)), Look::kUnknown);  // 0.26 m from the next rays
  EXPECT_EQ(visibility.at(at(8, 5)), Look::kSeenThrough);
  EXPECT_EQ(visibilityOf(cloud, {.aside = 0.3}).at(at(15, 5)), Look::kSeenThrough);
  EXPECT_EQ(visibilityOf(cloud, {.aside_share = 0.02}).at(at(15, 5)), Look::kSeenThrough);
}

TEST(Visibility, TakesNoLineThatAllButMeetsTheSensorForAWall) {
  octomap::Pointcloud cloud = test::wallAndGround(50, 64, 1024);
  for (octomap::point3d& p : cloud) {  // somebody 12 m away
    const double azimuth = std::atan2(p.y(), p.x());
    if (p.x() > 12 && azimuth > 0 && azimuth < 0.04) p *= 12 / p.x();
  }
  const std::array<float, 3> behind{14, -0.02F, 0};  // seen in the column beside
  EXPECT_EQ(visibilityOf(cloud).at(behind), Look::kSeenThrough);
  EXPECT_EQ(visibilityOf(cloud, {.clearance = 0}).at(behind), Look::kUnknown);
}

TEST(Visibility, SkimsWhatIsFarBehindALevelTop) {
  octomap::Pointcloud cloud = test::wallAndGround(50, 64, 1024);
  for (octomap::point3d& p : cloud) {  // a row of cars, their tops 0.3 m below the sensor, 7 m away
    const octomap::point3d front = p * (7 / p.x());
    if (p.x() > 7 && front.z() < -0.3F) p = front;
  }
  const auto at = [&](float x, const VisibilityConfig& config = {}) {  // 0.2 degrees above the tops
    return visibilityOf(cloud, config).at({x, 0, x * (-0.3F / 7 + 0.0035F)});
  };
  EXPECT_EQ(at(20), Look::kSkimmed);
  EXPECT_EQ(at(12), Look::kSkimmed);
  EXPECT_EQ(at(10), Look::kUnknown);  // a top may be so long
  EXPECT_EQ(at(12, {.skim_from = 6}), Look::kUnknown);
  EXPECT_EQ(at(20, {.skim = 0.02}), Look::kUnknown);
  EXPECT_EQ(at(20, {.surface = 0.01, .surface_share = 0}), Look::kSeenThrough);
}

TEST(Visibility, DoesNotSeeThroughAWallAlongTheWay) {
  octomap::Pointcloud cloud = test::wallAndGround(60, 64, 512);
  for (octomap::point3d& p : cloud)
    if (p.y() > 3) p *= 3 / p.y();
  const Visibility visibility = visibilityOf(cloud, {.clearance = 2.5});
  for (int x = 0; x < 400; ++x)
    for (const float y : {2.95F, 3.05F})
      EXPECT_NE(visibility.at({static_cast<float>(x) / 10, y, 0}), Look::kSeenThrough) << x;
}

TEST(Visibility, OfLargeCubesSeesTheMiddle) {
  octomap::Pointcloud cloud = test::wallAndGround(20, 64, 1440);
  for (octomap::point3d& p : cloud)  // a post of 0.4 m, 6 m away
    if (p.x() > 6 && std::abs(p.y() / p.x() * 6) < 0.2F) p *= 6 / p.x();
  const ScanPoints scan = test::scanOf(cloud);
  const RangeImage image(measureProjection({}, scan), scan);
  const std::array<float, 3> beside{6, 0.45F, 0};
  EXPECT_EQ(Visibility(image, scan, {}, 0.4).at(beside), Look::kSeenThrough);
  EXPECT_EQ(Visibility(image, scan, {.ball = 1}, 0.4).at(beside), Look::kFilled);
}

TEST(Visibility, SeesCubesAsItSeesTheirCentres) {
  std::mt19937 random(8);
  std::uniform_int_distribution<int> near(-250, 250), height(-25, 15);
  std::uniform_real_distribution<float> unit(0, 1);
  octomap::Pointcloud cloud = test::wallAndGround(15);
  for (octomap::point3d& p : cloud)
    if (unit(random) < 0.1F) p *= 0.3F + 0.7F * unit(random);
  const Visibility visibility = visibilityOf(cloud);
  const SensorView view(KeySpace(kCube), octomap::pose6d(1, 2, 0.3F, 0, 0, 0.5));
  std::vector<CubesAt> places;
  for (int i = 0; i < 3000; ++i) {
    const auto at = [&](auto& along) { return static_cast<key_type>((kTreeMaxVal + along(random)) & ~3); };
    places.push_back({{at(near), at(near), at(height)}, random() | std::uint64_t{random() & random()} << 32});
  }
  std::vector<CubeLooks> looks(places.size());
  visibility.look(view, places, looks);
  std::size_t filled = 0, through = 0, skimmed = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    CubeLooks expected;
    forEachBit(places[i].cubes, [&](int bit) {
      const OcTreeKey cube = cubeOf(places[i].corner, bit);
      const Look look = visibility.at(view(cube[0], cube[1], cube[2]));
      if (look == Look::kFilled) expected.filled |= maskOf(bit);
      if (look == Look::kSeenThrough) expected.seen_through |= maskOf(bit);
      if (look == Look::kSkimmed) expected.skimmed |= maskOf(bit);
    });
    ASSERT_EQ(looks[i].filled, expected.filled) << i;
    ASSERT_EQ(looks[i].seen_through, expected.seen_through) << i;
    ASSERT_EQ(looks[i].skimmed, expected.skimmed) << i;
    filled += expected.filled != 0, through += expected.seen_through != 0, skimmed += expected.skimmed != 0;
  }
  EXPECT_GT(filled, 30U);
  EXPECT_GT(through, 300U);
  EXPECT_GT(skimmed, 10U);
}

TEST(Visibility, HidesNothingThatIsSeenThrough) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> unit(0, 1);
  int hidden = 0;
  for (int scene = 0; scene < 4; ++scene) {
    octomap::Pointcloud cloud = test::wallAndGround(12 + 8 * scene);
    for (octomap::point3d& p : cloud)  // holes and obstacles
      if (unit(random) < 0.2F) p *= 0.3F + 0.7F * unit(random);
    const Visibility visibility = visibilityOf(cloud);
    for (int i = 0; i < 2000; ++i) {
      const std::array<float, 3> centre{80 * (unit(random) - 0.5F), 80 * (unit(random) - 0.5F),
                                        6 * (unit(random) - 0.5F)};
      const float half = 0.4F;
      if (!visibility.hides(centre, 1.7321F * half)) continue;
      ++hidden;
      for (int k = 0; k < 100; ++k) {
        const auto off = [&] { return half * (2 * unit(random) - 1); };
        const Look look = visibility.at({centre[0] + off(), centre[1] + off(), centre[2] + off()});
        ASSERT_TRUE(look != Look::kSeenThrough && look != Look::kSkimmed);
      }
    }
  }
  EXPECT_GT(hidden, 500);
}

}  // namespace
}  // namespace rhmap
