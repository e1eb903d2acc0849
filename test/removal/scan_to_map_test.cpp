// SPDX-License-Identifier: BSD-3-Clause
#include "scan_to_map.hpp"

#include <gtest/gtest.h>

#include "small_world.hpp"

namespace rhmap {
namespace {

using test::kCube;
using test::occupy;

OcTreeKey at(double x, double y, double z) {
  OcTreeKey key;
  KeySpace(kCube).coordToKeyChecked(x, y, z, key);
  return key;
}

/// What a scan of a wall at 20 m and the ground makes of a map.
class Look {
 public:
  explicit Look(RemovalConfig config = {}) : config_(std::move(config)) {}

  RegionMap& map() { return map_; }
  void ghost(double x, double y) {  // 0.4 x 0.4 x 1.2 m
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 12; ++k) occupy(map_, at(x + 0.1 * i, y + 0.1 * j, -1.3 + 0.1 * k));
  }
  RemovalResult scan(bool everywhere = false, bool protect = true) {
    const ScanPoints points = test::scanOf(test::wallAndGround(20, 64, 1440));
    ScanTrace trace = traceScan(map_, points, at(0, 0, 0), ++scans_, {.resolution = kCube});
    const RangeImage image(measureProjection({}, points), points);
    std::shared_ptr<const Visibility> visibility;
    if (config_.visibility.enabled) visibility = std::make_shared<Visibility>(image, points, config_.visibility, kCube);
    const ScanContext context{contextsOf(trace), {}, SensorView(KeySpace(kCube), octomap::pose6d()), visibility};
    RemovalResult result;
    removeByScan(map_, context, config_, kCube,
                 {.scan = scans_, .protect = protect, .revert_hits = revert_hits, .everywhere = everywhere}, result);
    return result;
  }
  int revert_hits = 0;

 private:
  RemovalConfig config_;
  RegionMap map_ = test::emptyMap();
  std::uint32_t scans_ = 0;
};

std::size_t cubesOf(const RemovalResult& result) {
  std::size_t cubes = 0;
  for (const RemovedCubesOf& removed : result.removed) cubes += static_cast<std::size_t>(std::popcount(removed.cubes));
  return cubes;
}

TEST(ScanToMapRemoval, TakesWhatTheScanSeesThroughAtOnceWhereTheRatioIsLow) {
  Look look;
  look.ghost(10, 0);
  EXPECT_GT(cubesOf(look.scan()), 100U);
  EXPECT_FALSE(test::isOccupied(look.map(), at(10.15, 0.15, -0.85)));
}

TEST(ScanToMapRemoval, LeavesWhatIsHidden) {
  Look look;
  look.ghost(25, 0);  // behind the wall
  EXPECT_EQ(cubesOf(look.scan(true)), 0U);
}

TEST(ScanToMapRemoval, TakesNothingThatTheScanHasHit) {
  RemovalConfig config;
  config.visibility.enabled = false;
  config.evidence.share = 0;
  config.context.min_points = 1;
  Look look(config);
  look.ghost(10, 0);
  look.scan();
  const ScanPoints points = test::scanOf(test::wallAndGround(20, 64, 1440));
  for (const OcTreeKey& cube : points.cube) ASSERT_TRUE(test::isOccupied(look.map(), cube));
}

TEST(ScanToMapRemoval, LeavesWhatIsSafeGround) {
  Look look;
  look.ghost(10, 0);
  const OcTreeKey low = at(10.15, 0.15, -1.25);
  look.map().regionOf(low)->octants[look.map().octantOf(low)].safe = maskOf(bitOf(low));
  look.scan();
  EXPECT_TRUE(test::isOccupied(look.map(), low));
}

TEST(ScanToMapRemoval, LeavesWhatStandsAmongFirmCubes) {
  Look look;
  look.ghost(10, 0);
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 12; ++k)  // a firm fence through it that is not seen through
      for (int j = 4; j < 10; ++j) {
        Octant& octant = occupy(look.map(), at(10 + 0.1 * i, 0.1 * j, -1.3 + 0.1 * k));
        octant.firm = octant.safe = octant.occupied;
      }
  const std::size_t with_fence = cubesOf(look.scan());
  EXPECT_EQ(with_fence, 0U);
}

TEST(ScanToMapRemoval, LooksEverywhereTwice) {
  RemovalConfig config;
  config.context.delta_1 = 0;  // no candidates
  config.evidence.interval = 1;
  Look look(config);
  look.ghost(10, 0);
  EXPECT_EQ(cubesOf(look.scan(false)), 0U);
  EXPECT_EQ(cubesOf(look.scan(true)), 0U);
  EXPECT_GT(cubesOf(look.scan(true)), 100U);
}

TEST(ScanToMapRemoval, LeavesWhatHasStoppedToTheBackEndsGuard) {
  for (const int revert_hits : {0, 20}) {
    Look look;
    look.revert_hits = revert_hits;
    look.ghost(10, 0);
    look.map().forEachColumn([](Column& column) {
      for (const auto& region : column.regions)
        for (OctantCounts& counts : region->counts) counts.fill({.hits = 20, .misses = 0});
    });
    EXPECT_EQ(cubesOf(look.scan()) > 0, revert_hits == 0);
  }
}

}  // namespace
}  // namespace rhmap
