// SPDX-License-Identifier: BSD-3-Clause
#include "free_space.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "small_world.hpp"

namespace rhmap {
namespace {

using test::kCube;

/// Scans of a hall with walls 6 m from the sensor in x and y, floor and ceiling 2 m from it.
class Hall {
 public:
  explicit Hall(const VoidConfig& config = {}, int degrees_between_beams = 1)
      : interval_(config.interval), between_beams_(degrees_between_beams), free_space_(config, kCube) {}

  /// With a post at (x, 0) between the floor and the ceiling, if x is above 0. From so far above the middle [m].
  void scan(double post = 0, double lift = 0) {
    octomap::Pointcloud cloud;
    for (int i = 0; i < 90; i += between_beams_) {
      for (int j = 0; j < 720; ++j) {
        const double elevation = (i - 44.5) * 3.14159 / 180, azimuth = j * 3.14159 / 360;
        const double x = std::cos(elevation) * std::cos(azimuth), y = std::cos(elevation) * std::sin(azimuth),
                     z = std::sin(elevation);
        double range = std::min({6 / std::abs(x + 1e-9), 6 / std::abs(y + 1e-9), 2 / std::abs(z + 1e-9)});
        if (post > 0 && x > 0 && std::abs(y / x * post) < 0.3) range = std::min(range, post / x);
        cloud.push_back(static_cast<float>(range * x), static_cast<float>(range * y), static_cast<float>(range * z));
      }
    }
    const ScanTrace trace = test::trace(map_, test::scanOf(cloud), sensor_, ++scans_, {.resolution = kCube});
    free_space_.observe(trace, {static_cast<float>(kTreeMaxVal), static_cast<float>(kTreeMaxVal),
                                static_cast<float>(kTreeMaxVal + lift / kCube)});
  }
  bool isVoid(double x, double y, double z) const { return free_space_.isVoid(cell(x), cell(y), cell(z)); }
  /// In how many followed scans rays have crossed a cell, as far as that is counted.
  unsigned crossings(double x, double y, double z) const {
    unsigned n = 0;
    while (n < 7 && free_space_.isCrossed(cell(x), cell(y), cell(z), interval_ * n)) ++n;
    return n;
  }
  FreeSpace& freeSpace() { return free_space_; }

 private:
  int cell(double v) const { return static_cast<int>(std::floor(v / kCube) + kTreeMaxVal) >> free_space_.shift(); }

  int interval_, between_beams_;
  OcTreeKey sensor_{kTreeMaxVal, kTreeMaxVal, kTreeMaxVal};
  RegionMap map_ = test::emptyMap();
  FreeSpace free_space_;
  std::uint32_t scans_ = 0;
};

TEST(FreeSpace, IsVoidAfterTauFScansAwayFromAllWalls) {
  Hall hall;
  for (int i = 0; i < 5; ++i) hall.scan();
  EXPECT_FALSE(hall.isVoid(3, 0.5, 0));
  hall.scan();
  EXPECT_TRUE(hall.isVoid(3, 0.5, 0));
  EXPECT_TRUE(hall.isVoid(-2, 3, 0.3));
  EXPECT_FALSE(hall.isVoid(5.7, 0.5, 0));   // beside a wall
  EXPECT_FALSE(hall.isVoid(6.1, 0.5, 0));   // in it
  EXPECT_FALSE(hall.isVoid(8, 0.5, 0));     // behind it
  EXPECT_FALSE(hall.isVoid(3, 0.5, -1.9));  // on the floor
}

TEST(FreeSpace, FollowsTheRaysOfEverySoManyScans) {
  for (const int interval : {1, 2, 3}) {
    Hall hall({.interval = interval, .tau_f = 2});
    for (int i = 0; i < 2 * interval - 1; ++i) hall.scan();
    EXPECT_FALSE(hall.isVoid(3, 0.5, 0));
    hall.scan();
    EXPECT_TRUE(hall.isVoid(3, 0.5, 0));
  }
}

TEST(FreeSpace, IsNotVoidWhereAnyScanHasJustHitSomething) {
  Hall hall({.interval = 2, .tau_f = 3});
  for (int i = 0; i < 4; ++i) hall.scan();
  hall.scan(3);  // whose rays are not followed
  hall.scan();
  EXPECT_TRUE(hall.isVoid(-3, 0.5, 0));
  EXPECT_FALSE(hall.isVoid(3, 0, 0));
  for (int i = 0; i < 4; ++i) hall.scan();
  EXPECT_TRUE(hall.isVoid(3, 0, 0));
}

TEST(FreeSpace, IsNotVoidWhereSomethingStandsAllTheTime) {
  Hall hall;
  for (int i = 0; i < 8; ++i) hall.scan(3);
  EXPECT_FALSE(hall.isVoid(3, 0, 0));
  EXPECT_FALSE(hall.isVoid(4, 0, 0));  // in its shadow
  EXPECT_TRUE(hall.isVoid(1.5, 0, 0));
}

TEST(FreeSpace, CountsAllScansWhoseRaysHaveCrossedACell) {
  Hall hall({.interval = 2});
  for (int i = 0; i < 8; ++i) hall.scan(i == 3 || i == 6 ? 3 : 0);  // the rays of the second are not followed
  EXPECT_EQ(hall.crossings(3, 0, 0), 3U);
  EXPECT_EQ(hall.crossings(4, 0, 0), 3U);  // in the shadow
  EXPECT_EQ(hall.crossings(2, 0, 0), 4U);
  EXPECT_EQ(hall.crossings(-3, 0.5, 0), 4U);
  EXPECT_EQ(hall.crossings(6.1, 0.5, 0), 0U);  // in a wall
  EXPECT_EQ(hall.crossings(200, 0, 0), 0U);
  for (int i = 0; i < 40; ++i) hall.scan();
  EXPECT_EQ(hall.crossings(3, 0, 0), 7U);
  EXPECT_TRUE(hall.freeSpace().isCrossed(kTreeMaxVal >> 2, kTreeMaxVal >> 2, kTreeMaxVal >> 2, 100));  // 7 are many
}

TEST(FreeSpace, MovesUpAndDownWithTheSensor) {
  Hall hall({.interval = 1});
  for (int i = 0; i < 5; ++i) hall.scan();
  for (const double lift : {1.6, -1.6, 0.0}) {
    hall.scan(0, lift);
    EXPECT_TRUE(hall.isVoid(3, 0.5, 0)) << lift;
    EXPECT_FALSE(hall.isVoid(3, 0.5, -2.5)) << lift;
    EXPECT_GE(hall.crossings(3, 0.5, 0), 5U) << lift;
    EXPECT_EQ(hall.crossings(3, 0.5, -2.5), 0U) << lift;
  }
}

TEST(FreeSpace, HasNoGapsOfACellBetweenBeams) {
  const auto isVoidAllTheWayUp = [](int degrees_between_beams) {
    Hall hall({.interval = 1}, degrees_between_beams);
    for (int i = 0; i < 3; ++i) hall.scan();
    bool all = true;
    for (double z = -1; z < 1; z += kCube) all = all && hall.isVoid(5, 0.5, z);
    return all;
  };
  EXPECT_TRUE(isVoidAllTheWayUp(1));
  EXPECT_TRUE(isVoidAllTheWayUp(6));    // 0.5 m apart
  EXPECT_FALSE(isVoidAllTheWayUp(18));  // 1.6 m
}

TEST(FreeSpace, ComesBackWhenSomethingStays) {
  Hall hall({.interval = 1, .tau_r = 10});
  for (int i = 0; i < 6; ++i) hall.scan();
  EXPECT_TRUE(hall.isVoid(3, 0, 0));
  for (int i = 0; i < 9; ++i) hall.scan(3);
  EXPECT_TRUE(hall.isVoid(3, 0, 0));
  hall.scan(3);
  EXPECT_FALSE(hall.isVoid(3, 0, 0));
  EXPECT_TRUE(hall.isVoid(-3, 0.5, 0));
}

TEST(FreeSpace, CanHaveSmallerCells) {
  Hall hall({.cell = 0.2});
  EXPECT_EQ(hall.freeSpace().shift(), 1);
  for (int i = 0; i < 6; ++i) hall.scan();
  EXPECT_TRUE(hall.isVoid(2, 0.5, 0));
  EXPECT_FALSE(hall.isVoid(6.1, 0.5, 0));
}

TEST(FreeSpace, ForgetsWhatIsFar) {
  Hall hall;
  for (int i = 0; i < 6; ++i) hall.scan();
  const std::size_t all = hall.freeSpace().memoryUsage();
  hall.freeSpace().forgetBeyond({kTreeMaxVal, kTreeMaxVal, kTreeMaxVal}, 20);
  EXPECT_LT(hall.freeSpace().memoryUsage(), all);
  hall.freeSpace().forgetBeyond({kTreeMaxVal + 4000, kTreeMaxVal, kTreeMaxVal}, 20);
  hall.scan();
  EXPECT_FALSE(hall.isVoid(3, 0.5, 0));
}

}  // namespace
}  // namespace rhmap
