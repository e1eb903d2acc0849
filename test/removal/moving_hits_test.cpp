// SPDX-License-Identifier: BSD-3-Clause
#include "moving_hits.hpp"

#include <gtest/gtest.h>

#include <array>

#include "ground.hpp"
#include "range_image.hpp"
#include "small_world.hpp"

namespace rhmap {
namespace {

using test::kCube;

/// A place in front of a wall and above the ground, with or without a box in it, seen from the origin.
class Place {
 public:
  explicit Place(const RemovalConfig& config = {})
      : config_(config), ground_(config.ground, kCube), free_space_(config.free_space, kCube), moving_(config, kCube) {}

  /// A box of 1.4 m, 1.2 m wide, on the ground at x = 8 m if `box`; before it, at x = 5 m, a screen from y = -1.5 m on
  /// to `screen_end`. Returns the number of rejected cubes.
  std::size_t scan(bool box, float screen_end = -1.5F) {
    octomap::Pointcloud cloud = test::wallAndGround(16, 64, 1440);
    for (octomap::point3d& p : cloud) {
      const float y = p.y() / p.x() * 5;
      if (p.x() > 5 && y > -1.5F && y < screen_end) p *= 5 / p.x();
    }
    if (box) {
      for (octomap::point3d& p : cloud) {
        const octomap::point3d front = p * (8 / p.x());
        if (p.x() > 8 && std::abs(front.y()) < 0.6F && front.z() < -0.3F) p = front;
      }
    }
    return insert(cloud);
  }
  /// A post of 1.4 m, 0.3 m wide, at x = 8 m if `post`, half a metre from a wall that runs along x.
  std::size_t scanBesideWall(bool post) {
    octomap::Pointcloud cloud = test::wallAndGround(16, 64, 1440);
    for (octomap::point3d& p : cloud) {
      if (p.x() > 3 && p.y() > 0.7F) p *= 0.7F / p.y();
      const octomap::point3d front = p * (8 / p.x());
      if (post && p.x() > 8 && std::abs(front.y() - 0.2F) < 0.15F && front.z() < -0.3F) p = front;
    }
    return insert(cloud);
  }
  /// A top 0.2 m high, level with the sensor and 1.2 m wide, at x = 14 m if `top`, behind a row of cars at x = 5 m that
  /// are hardly lower.
  std::size_t scanOverTops(bool top) {
    octomap::Pointcloud cloud = test::wallAndGround(30, 64, 1440);
    for (octomap::point3d& p : cloud) {
      const octomap::point3d cars = p * (5 / p.x()), front = p * (14 / p.x());
      if (top && p.x() > 14 && std::abs(front.y()) < 0.6F && front.z() < 0) p = front;
      if (p.x() > 5 && cars.z() < -0.05F) p = cars;
    }
    return insert(cloud);
  }
  /// Cubes of the map in the front of the box, so high above the ground [m].
  int cubesOfBox(double from, double to) const {
    int count = 0;
    for (int y = -6; y < 6; ++y) {
      for (int z = static_cast<int>((from - 1.7) / kCube); z < static_cast<int>((to - 1.7) / kCube); ++z) {
        for (int x = 79; x <= 80; ++x) count += test::isOccupied(map_, test::cubeAt(x, y, z));
      }
    }
    return count;
  }

  const std::vector<OcTreeKey>& rejectedFrom() const { return moving_.rejectedFrom(); }
  /// Cubes of earlier scans that the last one has taken out of the map.
  std::size_t numRemoved() const { return removed_.size(); }

 private:
  std::size_t insert(const octomap::Pointcloud& cloud) {
    const ScanPoints points = test::scanOf(cloud, 1);
    const ScanTrace trace = test::trace(map_, points, sensor_, ++scans_, {.resolution = kCube});
    ground_.update(map_, trace);
    const SensorView view(KeySpace(kCube), octomap::pose6d{});
    free_space_.observe(trace, view.origin());
    removed_.clear();
    const std::size_t rejected = moving_.reject(map_, trace, free_space_, removed_);
    const RangeImage image(measureProjection({}, points), points);
    moving_.remember(scans_, {{}, {}, view, std::make_shared<Visibility>(image, points, config_.visibility, kCube)});
    return rejected;
  }

  OcTreeKey sensor_{kTreeMaxVal, kTreeMaxVal, kTreeMaxVal};
  RemovalConfig config_;
  RegionMap map_ = test::emptyMap();
  GroundEstimation ground_;
  FreeSpace free_space_;
  MovingHits moving_;
  std::uint32_t scans_ = 0;
  std::vector<RemovedCubesOf> removed_;
};

TEST(MovingHits, AreNoneWhereEverythingStands) {
  Place place;
  for (int i = 0; i < 12; ++i) EXPECT_EQ(place.scan(true), 0U);
  EXPECT_GT(place.cubesOfBox(0.3, 1.3), 50);
}

TEST(MovingHits, AreAllOfABoxThatComesIntoTheVoidWithItsFeet) {
  RemovalConfig config;
  config.look_back.enabled = false;
  Place place(config);
  for (int i = 0; i < 8; ++i) place.scan(false);
  EXPECT_TRUE(place.rejectedFrom().empty());
  EXPECT_GT(place.scan(true), 50U);
  EXPECT_EQ(place.cubesOfBox(0.3, 1.3), 0);
  EXPECT_GT(place.rejectedFrom().size(), 9U);  // octants that a front of 1.2 by 1.3 m covers
  place.scan(false);
  EXPECT_TRUE(place.rejectedFrom().empty());
}

TEST(MovingHits, AreFoundBesideAWallIfMuchIsNew) {
  RemovalConfig config;
  config.look_back.enabled = false;
  for (const bool at_all : {true, false}) {
    if (!at_all) config.free_space.least_new = 10;
    Place place(config);
    for (int i = 0; i < 8; ++i) EXPECT_EQ(place.scanBesideWall(false), 0U);
    const std::size_t rejected = place.scanBesideWall(true);
    if (at_all) {
      EXPECT_GT(rejected, 25U);
    } else {
      EXPECT_EQ(rejected, 0U);
    }
  }
}

TEST(MovingHits, AreFoundByLookingBack) {
  for (const bool void_too : {true, false}) {
    RemovalConfig config;
    config.free_space.enabled = void_too;
    config.free_space.tau_f = 7;
    config.look_back.stride = 3;
    Place place(config);
    for (int i = 0; i < 6; ++i) place.scan(false);  // two scans remembered, and no void yet
    EXPECT_GT(place.scan(true), 50U);
    EXPECT_EQ(place.cubesOfBox(0.3, 1.3), 0);
  }
}

TEST(MovingHits, HaveComeOnlyIfEnoughIsNew) {
  for (const bool enough : {true, false}) {
    RemovalConfig config;
    config.free_space.enabled = false;
    config.look_back.stride = 3;
    config.look_back.least = enough ? 0.1 : 10;  // [m^2]; the box shows 1.7
    Place place(config);
    for (int i = 0; i < 6; ++i) place.scan(false);
    EXPECT_EQ(place.scan(true) > 50, enough);
  }
}

TEST(MovingHits, HaveComeWhereMorePastScansSawThroughThanSawSomething) {
  RemovalConfig config;
  config.free_space.enabled = false;
  config.look_back.stride = 1;
  config.look_back.scans = 5;
  Place place(config);
  for (int i = 0; i < 3; ++i) place.scan(false);
  for (int i = 0; i < 3; ++i) EXPECT_GT(place.scan(true), 50U) << i;  // 3 against 0, 1 and 2
  EXPECT_LT(place.scan(true), 10U);                                   // 2 against 3
  EXPECT_GT(place.cubesOfBox(0.3, 1.3), 50);
}

TEST(MovingHits, HaveComeWherePastScansSkimmed) {
  for (const bool skims : {true, false}) {
    RemovalConfig config;
    config.free_space.enabled = false;
    config.look_back.stride = 3;
    config.ground.enabled = false;  // to which a single row would look like the ground
    if (!skims) config.visibility.skim = 0;
    Place place(config);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(place.scanOverTops(false), 0U);
    EXPECT_EQ(place.scanOverTops(true) > 4, skims);
  }
}

TEST(MovingHits, TakeAlongWhatIsSoManyStepsFromWhatHasCome) {
  const auto rejected = [](int growth, double near) {
    RemovalConfig config;
    config.free_space.enabled = false;
    config.look_back.stride = 3;
    config.look_back.growth = growth;
    config.look_back.near = near;
    Place place(config);
    for (int i = 0; i < 6; ++i) place.scan(false, 0.0F);  // one half of the box's place was hidden
    return place.scan(true);
  };
  EXPECT_GT(rejected(0, 30), 50U);
  EXPECT_LT(rejected(0, 30), rejected(1, 30));
  EXPECT_LT(rejected(1, 30), rejected(2, 30));
  EXPECT_EQ(rejected(2, 6), rejected(1, 30));  // the box is 8 m away
  EXPECT_EQ(rejected(0, 6), rejected(0, 30));
}

TEST(MovingHits, AreNotFoundByLookingBackWhereReturnsWereTooNearToCount) {
  for (const double min_range : {7.0, 9.0}) {  // [m]; the box is 8 m away
    RemovalConfig config;
    config.free_space.enabled = false;
    config.look_back.stride = 3;
    config.min_range = min_range;
    Place place(config);
    for (int i = 0; i < 6; ++i) place.scan(false);
    EXPECT_EQ(place.scan(true) > 50, min_range < 8);
  }
}

TEST(MovingHits, AreNotFoundByAVoidThatIsOff) {
  RemovalConfig config;
  config.free_space.enabled = false;
  config.look_back.enabled = false;
  Place place(config);
  for (int i = 0; i < 8; ++i) place.scan(false);
  EXPECT_EQ(place.scan(true), 0U);
}

TEST(MovingHits, WithoutVoidAndLookingBackGoIntoTheMap) {
  RemovalConfig config;
  config.free_space.tau_f = 7;
  config.look_back.enabled = false;
  Place place(config);
  for (int i = 0; i < 6; ++i) place.scan(false);
  EXPECT_EQ(place.scan(true), 0U);
  EXPECT_GT(place.cubesOfBox(0.3, 1.3), 50);
}

TEST(MovingHits, ThatStayComeIntoTheMap) {
  RemovalConfig config;
  config.free_space.tau_r = 10;
  Place place(config);
  for (int i = 0; i < 8; ++i) place.scan(false);
  for (int i = 0; i < 30; ++i) place.scan(true);
  EXPECT_GT(place.cubesOfBox(0.3, 1.3), 50);
}

TEST(MovingHits, AreNoneOfWhatHasBeenHitManyTimes) {
  RemovalConfig config;
  config.look_back.enabled = false;
  config.free_space.interval = 1;
  config.free_space.tau_f = 7;
  config.free_space.known = 3;
  for (const int before : {2, 4}) {  // scans of the box before its place is void
    Place place(config);
    for (int i = 0; i < before; ++i) place.scan(true);
    for (int i = 0; i < 12; ++i) place.scan(false);
    const std::size_t rejected = place.scan(true);
    EXPECT_EQ(rejected > 50, before == 2) << rejected;
    EXPECT_EQ(place.cubesOfBox(0.3, 1.3) > 50, before == 4);
    EXPECT_EQ(place.numRemoved() > 0, before == 2);  // what the map had before is reported
  }
}

TEST(MovingHits, AreNotFoundByLookingBackWhereThingsWereHidden) {
  RemovalConfig config;
  config.free_space.tau_f = 7;
  Place place(config);
  for (int i = 0; i < 6; ++i) place.scan(false, 1.5F);
  EXPECT_EQ(place.scan(true), 0U);
  EXPECT_GT(place.cubesOfBox(0.3, 1.3), 50);
}

}  // namespace
}  // namespace rhmap
