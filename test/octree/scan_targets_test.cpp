// SPDX-License-Identifier: BSD-3-Clause
// A scan update gives OctoMap's map on every instruction set and with any number of threads.
#include <cmath>
#include <limits>
#include <random>

#include "oracle.hpp"
#include "rhmap/octree/octree.hpp"
#include "targets.hpp"

namespace rhmap {
namespace {

/// A room with walls of cells that are hit again and again, so that much is pruned, expanded and clamped; and points
/// that are nowhere, outside of the tree, and as far as floats go.
octomap::Pointcloud hostileScan(const point3d& origin, float cell, std::mt19937& random) {
  octomap::Pointcloud scan;
  std::uniform_real_distribution<float> wall(-12 * cell, 12 * cell);
  std::uniform_real_distribution<float> anywhere(-60 * cell, 60 * cell);
  for (int i = 0; i < 3000; ++i) {
    const float side = i % 2 == 0 ? 12 * cell : -12 * cell;
    const point3d on_wall[] = {
        {side, wall(random), wall(random)}, {wall(random), side, wall(random)}, {wall(random), wall(random), side}};
    scan.push_back(origin + on_wall[i % 3]);
  }
  for (int i = 0; i < 300; ++i) scan.push_back(origin + point3d(anywhere(random), anywhere(random), anywhere(random)));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const float most = std::numeric_limits<float>::max();
  const float tree = 32768 * cell;
  for (const float bad : {nan, inf, -inf, most, -most, tree, -tree, 3 * tree, -3 * tree, 1e-30F, -1e-30F, 0.0F, -0.0F})
    for (int axis = 0; axis < 3; ++axis) {
      point3d p = origin + point3d(cell, 2 * cell, 3 * cell);
      p(static_cast<unsigned>(axis)) = bad;
      scan.push_back(p);
    }
  scan.push_back(origin);
  return scan;
}

struct Case {
  double max_range;
  bool lazy, discretize;
};

class ScanUpdateOn : public test::OnTarget {};

TEST_P(ScanUpdateOn, GivesOctomapsMapWithAnyNumberOfThreads) {
  std::mt19937 random(17);
  for (const double resolution : {0.1, 0.25}) {
    for (const Case& c : {Case{-1, false, false}, Case{40 * resolution, false, false}, Case{0, false, false},
                          Case{40 * resolution, true, false}, Case{40 * resolution, false, true}}) {
      test::OctomapOracle theirs(resolution);
      OcTree alone(resolution), together(resolution);
      together.setNumThreads(3);
      for (int i = 0; i < 6; ++i) {
        // The sensor stands still now and then: the same cells again until they are clamped.
        const point3d origin(static_cast<float>(i / 3) * 0.33F, 0.02F, -0.01F);
        octomap::Pointcloud scan = hostileScan(origin, static_cast<float>(resolution), random);
        if (c.max_range < 0) {  // OctoMap walks to the end of the tree; a few such rays will do
          octomap::Pointcloud near;
          for (const point3d& p : scan)
            if (!(std::fabs(p.x()) > 1000 && std::fabs(p.x()) < 10000)) near.push_back(p);
          scan = near;
        }
        for (OcTree* ours : {&alone, &together}) {
          ours->insertPointCloud(scan, origin, c.max_range, c.lazy, c.discretize);
          if (!c.discretize) {
            ASSERT_EQ(ours->lastScan().points, scan.size());
          }
        }
        octomap::Pointcloud finite;  // others OctoMap 1.9 takes for points far away
        for (const point3d& p : scan)
          if (std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z())) finite.push_back(p);
        EXPECT_EQ(alone.lastScan().not_finite, scan.size() - finite.size());
        theirs.insertPointCloud(finite, origin, c.max_range, c.lazy, c.discretize);
        ASSERT_TRUE(test::otBytes(alone) == test::otBytes(theirs))
            << resolution << " m, scan " << i << ", range " << c.max_range << (c.lazy ? ", lazy" : "");
        ASSERT_TRUE(test::otBytes(together) == test::otBytes(theirs)) << "with three threads";
        ASSERT_EQ(together.lastScan().outside, alone.lastScan().outside);
        if (c.lazy && i % 2 == 1) {
          for (OcTree* ours : {&alone, &together}) {
            ours->updateInnerOccupancy();
            ours->prune();
          }
          theirs.updateInnerOccupancy();
          theirs.prune();
        }
      }
      ASSERT_EQ(alone.size(), theirs.size());
      ASSERT_EQ(together.size(), theirs.size());
    }
  }
}

TEST_P(ScanUpdateOn, KeepsOctomapsAbortsAndTiesAlsoForStrangeValues) {
  constexpr double kResolution = 0.1;
  std::mt19937 random(23);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  OcTree ours(kResolution);
  test::OctomapOracle theirs(kResolution);
  const auto both = [&](auto&& change) {
    change(ours);
    change(theirs);
  };
  const point3d origin(0.01F, 0.02F, 0.03F);
  for (int round = 0; round < 12; ++round) {
    // Values beyond the clamping, zeros of both signs and NaN, written as a user may write them.
    for (int i = 0; i < 400; ++i) {
      const auto coordinate = [&] { return static_cast<key_type>(32768 - 12 + static_cast<int>(random() % 24)); };
      const OcTreeKey key(coordinate(), coordinate(), coordinate());
      const float values[] = {0.0F, -0.0F, 5.0F, -5.0F, nan, 0.3F};
      const float value = values[random() % 6];
      both([&](auto& map) {
        if (auto* node = map.search(key)) node->setLogOdds(value);
      });
    }
    both([&](auto& map) {
      map.setProbHit(round % 4 == 3 ? 0.4 : 0.7);  // a hit that lowers
      map.setClampingThresMax(round % 3 == 2 ? 0.6 : 0.97);
    });
    const octomap::Pointcloud scan = [&] {
      octomap::Pointcloud s;
      std::uniform_real_distribution<float> near(-1.2F, 1.2F);
      for (int i = 0; i < 500; ++i) s.push_back(near(random), near(random), near(random));
      return s;
    }();
    both([&](auto& map) { map.insertPointCloud(scan, origin); });
    ASSERT_TRUE(test::otBytes(ours) == test::otBytes(theirs)) << "round " << round;
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, ScanUpdateOn, testing::ValuesIn(test::targetsHere()), test::targetName);

}  // namespace
}  // namespace rhmap
