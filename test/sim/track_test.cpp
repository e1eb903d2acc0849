// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/track.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace rhmap::sim::test {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Track, AStanceIsAtRest) {
  const Track track(Stance{{1, 2, 3}, 0.5});
  EXPECT_EQ(track.at(17).position, Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(track.movesWithin(-1e9, 1e9));
}

TEST(Track, GoesEvenlyBetweenWaypointsAndRestsOutside) {
  const Track track = straightTrack({{0, 0, 0}, kPi / 2}, 2, 1, 4);
  EXPECT_TRUE(track.at(2).position.isApprox(Eigen::Vector3d(0, 2, 0)));
  EXPECT_TRUE(track.at(99).position.isApprox(Eigen::Vector3d(0, 6, 0)));
  EXPECT_EQ(track.at(0).position, Eigen::Vector3d(0, 0, 0));
}

TEST(Track, TurnsTheShortWay) {
  const Track track({{0, {{0, 0, 0}, kPi - 0.1}}, {1, {{0, 0, 0}, -kPi + 0.1}}});
  EXPECT_NEAR(track.at(0.5).yaw, kPi, 1e-12);
}

TEST(Track, MovesOnlyWhileItDoes) {
  const Track track = joinTracks({straightTrack({{0, 0, 0}, 0}, 1, 2, 4), straightTrack({{2, 0, 0}, 0}, 1, 9, 10)});
  EXPECT_FALSE(track.movesWithin(0, 2));
  EXPECT_TRUE(track.movesWithin(0, 2.01));
  EXPECT_TRUE(track.movesWithin(3, 5));
  EXPECT_FALSE(track.movesWithin(4, 9));
  EXPECT_TRUE(track.movesWithin(0, 20));
  EXPECT_EQ(track.at(6).position, Eigen::Vector3d(2, 0, 0));
}

TEST(Track, LooksWhereItGoesOrBack) {
  EXPECT_NEAR(pathTrack({{0, 0, 0}, {0, 3, 0}}, 1, 0).at(1).yaw, kPi / 2, 1e-12);
  EXPECT_NEAR(pathTrack({{0, 0, 0}, {-3, 0, 0}}, 1, 0, true).at(1).yaw, 2 * kPi, 1e-12);
}

TEST(Track, TimeDoesNotRunBackwards) {
  EXPECT_THROW(Track(std::vector<Waypoint>{}), std::invalid_argument);
  EXPECT_THROW(Track({{1, {}}, {0, {}}}), std::invalid_argument);
}

}  // namespace
}  // namespace rhmap::sim::test
