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
    ScanTrace trace = test::trace(map_, points, at(0, 0, 0), ++scans_, {.resolution = kCube});
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
  for (std::size_t k = 0; k < points.size(); ++k) ASSERT_TRUE(test::isOccupied(look.map(), points.cubeAt(k)));
}

TEST(ScanToMapRemoval, LeavesWhatIsSafeGround) {
  Look look;
  look.ghost(10, 0);
  const OcTreeKey low = at(10.15, 0.15, -1.25);
  look.map().regionOf(low)->octant(look.map().octantOf(low)).safe = maskOf(bitOf(low));
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

TEST(ScanToMapRemoval, TakesDoubtsBackWhereItSeesSomething) {
  RemovalConfig config;
  config.evidence.interval = 1;
  Look look(config);
  const OcTreeKey in_wall = at(20.15, 0.15, -0.25);  // one behind what is hit
  Octant& octant = occupy(look.map(), in_wall);
  const Region* region = look.map().regionOf(in_wall);
  std::uint8_t& misses =
      historyOf(region->octant(look.map().octantOf(in_wall))).misses[static_cast<std::size_t>(bitOf(in_wall))];
  octant.doubted = maskOf(bitOf(in_wall));
  misses = 5;
  look.scan(true);
  EXPECT_EQ(octant.doubted, 0U);
  EXPECT_EQ(misses, 0);
}

TEST(ScanToMapRemoval, MakesFirmWhatScansOftenSeeSomethingAt) {
  for (const int filled : {2, 3}) {
    RemovalConfig config;
    config.evidence.filled = filled;
    config.evidence.interval = 1;
    Look look(config);
    const OcTreeKey in_wall = at(20.15, 0.15, -0.25), before = at(10.15, 0.15, -0.25);  // one behind what is hit
    const Octant& octant = occupy(look.map(), in_wall);
    const Octant& free = occupy(look.map(), before);
    for (int i = 1; i <= 3; ++i) {
      look.scan(true);
      EXPECT_EQ((octant.firm & maskOf(bitOf(in_wall))) != 0, i >= filled) << i;
    }
    EXPECT_EQ(free.firm, 0U);
    Region* region = look.map().regionOf(in_wall);
    region->remove(look.map().octantOf(in_wall), maskOf(bitOf(in_wall)));
    occupy(look.map(), in_wall);
    look.scan(true);
    EXPECT_EQ(octant.firm & maskOf(bitOf(in_wall)), 0U);  // what comes again is new
  }
}

TEST(ScanToMapRemoval, IsSureOfWhatItOftenSeesThroughNearFirmCubes) {
  const auto cubesGone = [](int scans, const RemovalConfig& config, std::uint8_t hits) {
    Look look(config);
    look.ghost(10, 0);
    look.map().forEachColumn([&](Column& column) {
      for (const auto& region : column.regions)
        forEachBit(region->known_octants, [&](int o) {
          OctantHistory& history = historyOf(region->octant(static_cast<std::size_t>(o)));
          history.hits.fill(hits);
          history.misses.fill(0);
        });
    });
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 12; ++k)
        for (const int j : {-4, -3, 6, 7}) {  // walls 0.3 m beside it
          const OcTreeKey cube = at(10 + 0.1 * i, 0.1 * j + 0.05, -1.3 + 0.1 * k);
          Octant& octant = occupy(look.map(), cube);
          octant.firm |= maskOf(bitOf(cube)), octant.safe |= maskOf(bitOf(cube));
        }
    std::size_t gone = 0;
    for (int i = 0; i < scans; ++i) gone += cubesOf(look.scan());
    return gone;
  };
  RemovalConfig config;
  EXPECT_EQ(cubesGone(config.evidence.sure_misses - 1, config, 1), 0U);
  EXPECT_GT(cubesGone(config.evidence.sure_misses, config, 1), 100U);
  EXPECT_EQ(cubesGone(config.evidence.sure_misses, config, 10), 0U);  // hit so often: more looks are needed
  EXPECT_GT(cubesGone(30, config, 10), 100U);
  config.evidence.sure_reach = 0.4;
  EXPECT_EQ(cubesGone(config.evidence.sure_misses, config, 1), 0U);
}

RemovalConfig withoutCandidates() {
  RemovalConfig config;
  config.context.delta_1 = 0;
  config.evidence.interval = 1;
  return config;
}

TEST(ScanToMapRemoval, LooksEverywhereTwice) {
  RemovalConfig config = withoutCandidates();
  config.evidence.enough = 100;
  Look look(config);
  look.ghost(10, 0);
  EXPECT_EQ(cubesOf(look.scan(false)), 0U);
  EXPECT_EQ(cubesOf(look.scan(true)), 0U);
  EXPECT_GT(cubesOf(look.scan(true)), 100U);
}

TEST(ScanToMapRemoval, LooksOnceWhereMuchIsDoubtedAndNothingFirm) {
  for (const bool is_small : {false, true}) {
    for (const bool with_firm : {false, true}) {
      Look look(withoutCandidates());
      if (is_small) {
        for (int k = 0; k < 12; ++k) occupy(look.map(), at(10, 0, -1.2 + 0.1 * k));
      } else {
        look.ghost(10, 0);
      }
      if (with_firm)
        for (int k = 0; k < 12; ++k) {
          const OcTreeKey beside = at(10, 0.6, -1.2 + 0.1 * k);
          Octant& octant = occupy(look.map(), beside);
          octant.firm |= maskOf(bitOf(beside));
          octant.safe |= maskOf(bitOf(beside));
        }
      EXPECT_EQ(cubesOf(look.scan(true)) > 0, !is_small && !with_firm) << is_small << with_firm;
    }
  }
}

TEST(ScanToMapRemoval, LooksAgainSoonerWhereThereAreDoubts) {
  std::size_t removed[2] = {};
  for (const int doubtful_interval : {1, 8}) {
    RemovalConfig config = withoutCandidates();
    config.evidence.enough = 100;
    config.evidence.interval = 8;
    config.evidence.doubtful_interval = doubtful_interval;
    Look look(config);
    look.ghost(10, 0);
    for (int i = 0; i < 9; ++i) removed[doubtful_interval == 1] += cubesOf(look.scan(true));
  }
  EXPECT_GT(removed[1], 100U);
  EXPECT_LT(removed[0], removed[1] / 2);
}

TEST(ScanToMapRemoval, LooksAtTheGroundLessOften) {
  for (const bool is_ground : {true, false}) {
    RemovalConfig config = withoutCandidates();
    config.evidence.ground_interval = 8;
    Look look(config);
    look.ghost(10, 0);
    if (is_ground) {
      look.map().forEachColumn([](Column& column) {
        for (Region* region : column.regions)
          forEachBit(region->known_octants, [&](int o) {
            Octant& octant = region->octant(static_cast<std::size_t>(o));
            octant.ground = octant.occupied;
          });
      });
    }
    int scans = 0, last = 0;
    for (std::size_t removed = 0; removed < 100 && scans < 20;) {
      ++scans;
      const std::size_t now = cubesOf(look.scan(true));
      removed += now;
      if (now > 0) last = scans;
    }
    EXPECT_EQ(last <= 2, !is_ground) << last;
    EXPECT_LT(scans, 20);
  }
}

TEST(ScanToMapRemoval, LeavesWhatHasStoppedToTheBackEndsGuard) {
  for (const int revert_hits : {0, 20}) {
    Look look;
    look.revert_hits = revert_hits;
    look.ghost(10, 0);
    look.map().forEachColumn([](Column& column) {
      for (const auto& region : column.regions)
        forEachBit(region->known_octants, [&](int o) {
          OctantHistory& history = historyOf(region->octant(static_cast<std::size_t>(o)));
          history.hits.fill(20);
          history.misses.fill(0);
        });
    });
    EXPECT_EQ(cubesOf(look.scan()) > 0, revert_hits == 0);
  }
}

}  // namespace
}  // namespace rhmap
