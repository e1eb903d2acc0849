// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/scenes.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <stdexcept>
#include <string>

#include "rhmap/sim/simulation.hpp"
#include "surface.hpp"

namespace rhmap::sim::test {
namespace {

struct EveryScene : testing::TestWithParam<SceneInfo> {
  std::string name{GetParam().name};

  /// Looks now and then through the whole of the scene.
  Simulation simulate(std::uint64_t seed = 1) const {
    const Scene scene = makeScene(name, seed);
    return Simulation({.scene = name,
                       .frames = 8,
                       .rate = 8 / scene.duration,
                       .seed = seed,
                       .lidar = {.beams = 16, .azimuth_step = 0.4, .range_noise = 0, .drop_out = 0}});
  }
};

const std::map<std::string, std::set<int>> kClasses{
    {"street", {10, 11, 30, 40, 48, 50, 51, 70, 71, 72, 80, 252, 253, 254}},
    {"highway", {40, 50, 51, 52, 70, 72, 80, 252, 257, 258}},
    {"hill", {40, 51, 52, 70, 71, 72, 80, 252, 253, 254, 259}},
    {"crowd", {30, 48, 50, 70, 71, 80, 254}},
    {"parking", {10, 40, 44, 50, 51, 70, 80, 252, 254}},
    {"indoor", {30, 49, 50, 99, 254}},
    {"static", {10, 11, 30, 40, 48, 50, 51, 70, 71, 72, 80}},
    {"drive", {10, 30, 40, 48, 50, 51, 70, 71, 72, 80, 252, 254}},
};

TEST_P(EveryScene, ShowsTheClassesItShould) {
  const Simulation simulation = simulate();
  std::set<int> seen;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    for (const std::uint32_t label : simulation.scan(k).labels) seen.insert(static_cast<int>(label & 0xFFFFU));
  }
  for (const int cls : kClasses.at(name)) EXPECT_TRUE(seen.count(cls)) << cls;
  EXPECT_FALSE(seen.count(0)) << "all that is hit has a class";
  if (name == "static") {
    EXPECT_LT(*seen.rbegin(), 252);
  }
}

/// With exact ranges, a point on a thing is on its surface, in the pose that it had then, and nowhere else.
TEST_P(EveryScene, PointsOnThingsAreOnTheirSurfaces) {
  const Simulation simulation = simulate();
  std::map<unsigned, const Object*> things;
  for (const Object& object : simulation.scene().objects) {
    if (object.instance == 0) continue;
    EXPECT_TRUE(things.emplace(object.instance, &object).second) << "instance " << object.instance << " twice";
  }
  std::size_t points = 0;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    const Eigen::Isometry3d sensor = simulation.scene().sensorPose(simulation.time(k));
    const LidarScan scan = simulation.scan(k);
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      const unsigned instance = scan.labels[i] >> 16;
      if (instance == 0) continue;
      const Object& thing = *things.at(instance);
      const Eigen::Vector3d world = sensor * Eigen::Vector3f(scan.points[i].data()).cast<double>();
      const Eigen::Vector3d local = simulation.scene().objectPose(thing, simulation.time(k)).inverse() * world;
      ASSERT_NEAR(surfaceDistance(thing, local), 0, 1e-4) << "scan " << k << ", point " << i;
      ++points;
    }
  }
  EXPECT_GT(points, 50U);
}

TEST_P(EveryScene, TheSensorIsAtItsHeightAndInsideOfNothing) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Scene scene = makeScene(name, seed);
    for (double time = 0; time < scene.duration; time += scene.duration / 200) {
      const Eigen::Isometry3d sensor = scene.sensorPose(time);
      const Eigen::Vector3d down = -sensor.linear().col(2);
      EXPECT_NEAR(scene.terrain.hitDistance(sensor.translation(), down, 10), 1.73, 1e-6) << time;
      for (const Object& object : scene.objects) {
        const Eigen::Vector3d local = scene.objectPose(object, time).inverse() * sensor.translation();
        ASSERT_GT(surfaceDistance(object, local), 0.3)
            << "class " << object.resting << " at " << time << " s, seed " << seed;
      }
    }
  }
}

TEST_P(EveryScene, ThingsMoveUnlessItIsTheStaticOne) {
  const Simulation simulation = simulate();
  int movers = 0;
  for (const std::uint32_t label : simulation.labels()) movers += isMoving(label) ? 1 : 0;
  if (name == "static") {
    EXPECT_EQ(movers, 0);
  } else {
    EXPECT_GT(movers, 8);
  }
}

TEST_P(EveryScene, HangsOnItsSeedAndOnNothingElse) {
  const Simulation one = simulate(5), same = simulate(5), other = simulate(6);
  EXPECT_EQ(one.scan(4).points, same.scan(4).points);
  EXPECT_EQ(one.scan(4).labels, same.scan(4).labels);
  EXPECT_NE(one.scan(4).points, other.scan(4).points);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(scenes().begin(), scenes().end()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Scenes, AnUnknownOneIsAnsweredWithAllThereAre) {
  try {
    makeScene("moon", 1);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()),
              "moon is not a scene; one of: street, highway, hill, crowd, parking, indoor, static, drive");
  }
}

TEST(Scenes, TheDriveIsThreeKilometresLongAndEndsWhereItBegan) {
  const Scene drive = makeScene("drive", 1);
  double length = 0;
  Eigen::Vector3d last = drive.sensorPose(0).translation();
  const Eigen::Vector3d first = last;
  for (double time = 0.1; time <= drive.duration; time += 0.1) {
    const Eigen::Vector3d here = drive.sensorPose(time).translation();
    length += (here - last).norm();
    last = here;
  }
  EXPECT_GT(length, 3000);
  EXPECT_LT((last - first).norm(), 60);
}

}  // namespace
}  // namespace rhmap::sim::test
