// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

namespace rhmap::sim::test {
namespace {

SimulationConfig small(const std::string& scene, std::size_t frames, double rate = 10) {
  return {.scene = scene, .frames = frames, .rate = rate, .lidar = {.beams = 16, .azimuth_step = 1}};
}

std::string refusal(const SimulationConfig& config) {
  try {
    Simulation simulation(config);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

/// SemanticKITTI's rule: whoever moves at any time of the sequence is a mover in all of it, and nobody else.
TEST(Simulation, AThingThatMovesAtAnyTimeIsAMoverAllTheTime) {
  const Simulation brief(small("parking", 10)), whole(small("parking", 500));
  const auto& objects = whole.scene().objects;
  ASSERT_EQ(objects.size(), brief.scene().objects.size());
  int later = 0, stoppers = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].resting != kCar) continue;
    const Track& track = objects[i].track;
    EXPECT_EQ(isMoving(brief.labels()[i]), track.movesWithin(0, 1));
    EXPECT_EQ(isMoving(whole.labels()[i]), track.movesWithin(0, 50));
    EXPECT_EQ(brief.labels()[i] >> 16, whole.labels()[i] >> 16) << "the instance stays";
    if (isMoving(whole.labels()[i]) && !isMoving(brief.labels()[i])) {
      ++later;
      EXPECT_EQ(brief.labels()[i] & 0xFFFFU, static_cast<unsigned>(kCar));
    }
    if (isMoving(whole.labels()[i]) && !track.movesWithin(30, 50)) ++stoppers;
  }
  EXPECT_EQ(std::count_if(whole.labels().begin(), whole.labels().end(),
                          [](std::uint32_t label) { return (label & 0xFFFFU) == kMovingCar; }),
            9);
  EXPECT_GE(later, 4) << "cars that leave after the first second";
  EXPECT_GE(stoppers, 3) << "cars that have arrived, still movers";

  // The scan shows it: a car that stands still by now has its moving class.
  std::set<std::uint32_t> at_rest;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (isMoving(whole.labels()[i]) && !objects[i].track.movesWithin(30, 50)) at_rest.insert(whole.labels()[i]);
  }
  const LidarScan scan = whole.scan(320);
  EXPECT_TRUE(
      std::any_of(scan.labels.begin(), scan.labels.end(), [&](auto label) { return at_rest.count(label) > 0; }));
}

TEST(Simulation, TheFirstScanHasTheSamePointsHoweverLongTheSequence) {
  EXPECT_EQ(Simulation(small("parking", 2)).scan(1).points, Simulation(small("parking", 200)).scan(1).points);
}

TEST(Simulation, TheWorldIsTheFrameOfTheFirstScan) {
  const Simulation simulation(small("street", 11));
  EXPECT_TRUE(simulation.truePose(0).isApprox(Eigen::Isometry3d::Identity(), 0));
  EXPECT_TRUE(simulation.truePose(10).translation().isApprox(Eigen::Vector3d(8, 0, 0)));
  EXPECT_EQ(simulation.toldPose(10).matrix(), simulation.truePose(10).matrix());
}

TEST(Simulation, PoseNoiseIsInThePosesAndNotInThePoints) {
  SimulationConfig config = small("street", 500);
  const Simulation exact(config);
  config.pose_noise = 0.1;
  const Simulation noisy(config);
  EXPECT_EQ(noisy.toldPose(0).matrix(), Eigen::Matrix4d::Identity());
  double squares = 0;
  for (std::size_t k = 1; k < 500; ++k)
    squares += (noisy.toldPose(k).translation() - noisy.truePose(k).translation()).squaredNorm();
  EXPECT_NEAR(std::sqrt(squares / (3 * 499)), 0.1, 0.01);
  EXPECT_EQ(noisy.scan(3).points, exact.scan(3).points);
}

TEST(Simulation, SaysWhatItCannotDo) {
  EXPECT_NE(refusal(small("moon", 1)).find("moon is not a scene"), std::string::npos);
  EXPECT_EQ(refusal(small("street", 601)), "the scene street lasts 60 s: at 10 Hz at most 600 frames");
  EXPECT_EQ(refusal(small("street", 600)), "");
  EXPECT_EQ(refusal(small("street", 0)), "SimulationConfig: frames is 0");
  EXPECT_EQ(refusal(small("street", 1, 0)), "SimulationConfig: rate is not above 0");
}

}  // namespace
}  // namespace rhmap::sim::test
