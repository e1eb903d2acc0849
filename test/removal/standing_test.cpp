// SPDX-License-Identifier: BSD-3-Clause
#include "standing.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "small_world.hpp"

namespace rhmap {
namespace {

using test::cubeAt;
using test::kCube;

/// Scans of one point each: in an octant 10 m from the sensor, or 3 m behind it, or elsewhere.
class World {
 public:
  explicit World(const StandingConfig& config, const VoidConfig& free_space = {.interval = 1})
      : config_(config), free_space_(free_space, kCube) {}

  /// Each time another cube of the octant.
  void hit(int times = 1) {
    for (int i = 0; i < times; ++i) scan(cubeOf(octant_, next_++));
  }
  /// The next hits are in another eighth of the octant.
  void nextEighth() { next_ = (next_ + 7) / 8 * 8; }
  void cross(int times) {
    for (int i = 0; i < times; ++i) scan(cubeAt(130, 1, 1));
  }
  void lookAway(int times) {
    for (int i = 0; i < times; ++i) scan(cubeAt(-100, 0, 0));
  }

  Octant& octant() { return map_.regionOf(octant_)->octant(map_.octantOf(octant_)); }
  int firmCubes() { return std::popcount(octant().firm); }

 private:
  void scan(const OcTreeKey& cube) {
    const ScanTrace trace =
        test::trace(map_, test::pointsIn({cube}), cubeAt(0, 0, 0), ++scans_, {.resolution = kCube, .firm = 255});
    const auto at = static_cast<float>(kTreeMaxVal);
    free_space_.observe(trace, {at, at, at});
    noteStanding(trace, free_space_, config_);
  }

  StandingConfig config_;
  OcTreeKey octant_ = cubeAt(100, 0, 0);
  RegionMap map_ = test::emptyMap();
  FreeSpace free_space_;
  std::uint32_t scans_ = 0;
  int next_ = 0;
};

TEST(Standing, IsWhatScansHitAgainAndAgainOverALongTime) {
  World world({.scans = 4, .time = 10});
  world.hit(9);
  EXPECT_EQ(world.firmCubes(), 0);
  world.lookAway(1);
  EXPECT_EQ(world.firmCubes(), 0);
  world.hit();  // ten scans after the first
  EXPECT_EQ(world.firmCubes(), 10);

  World seldom({.scans = 4, .time = 10});
  seldom.hit(2);
  seldom.lookAway(20);
  seldom.hit();
  EXPECT_EQ(seldom.firmCubes(), 0);
  seldom.hit();
  EXPECT_EQ(seldom.firmCubes(), 4);
}

TEST(Standing, IsNothingThatRaysCross) {
  const auto firm = [](double crossed, int crossings, int interval = 1) {
    World world({.scans = 8, .time = 0, .crossed = crossed}, {.interval = interval});
    world.hit(3);
    world.cross(crossings);
    world.hit(5);
    return world.firmCubes();
  };
  EXPECT_EQ(firm(0.5, 4), 8);
  EXPECT_EQ(firm(0.5, 5), 0);
  EXPECT_EQ(firm(0, 0), 8);
  EXPECT_EQ(firm(0, 1), 0);
  EXPECT_EQ(firm(100, 6), 8);
  EXPECT_EQ(firm(100, 7), 0);     // more are not counted
  EXPECT_EQ(firm(0.5, 6, 3), 0);  // two of these followed, which stand for six
  EXPECT_EQ(firm(0.75, 6, 3), 8);
}

TEST(Standing, IsToldCellByCellOfTheVoid) {
  for (const bool small : {false, true}) {
    World world({.scans = 4, .time = 0}, {.cell = small ? 0.2 : 0.4, .interval = 1});
    world.hit(3);
    world.nextEighth();
    world.hit(3);
    EXPECT_EQ(world.firmCubes(), small ? 0 : 6);
    world.hit();
    EXPECT_EQ(world.firmCubes(), small ? 4 : 7);
  }
}

TEST(Standing, IsNoCubeThatIsDoubted) {
  World world({.scans = 4, .time = 0});
  world.hit(3);
  world.octant().doubted = 1;
  world.hit();
  EXPECT_EQ(world.octant().firm, world.octant().occupied & ~std::uint64_t{1});
}

}  // namespace
}  // namespace rhmap
