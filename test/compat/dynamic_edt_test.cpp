// SPDX-License-Identifier: BSD-3-Clause
// dynamicEDT3D (distance to the nearest obstacle, kept up to date by change detection) takes its tree as a template
// parameter: rhmap::OcTree goes in as it is.
#include <dynamicEDT3D/dynamicEDTOctomap.h>
#include <gtest/gtest.h>

#include <memory>

#include "project/dice.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap::test {
namespace {

using octomap::OcTreeKey;
using octomap::point3d;

/// A tree and its distances, up to 1.5 m, in the middle of the room.
template <class Tree>
class Distances {
 public:
  explicit Distances(bool unknown_occupied) : map_(0.1) {
    Dice dice(21);
    for (int i = 0; i < 4; ++i) insertScan(dice);
    edt_ = std::make_unique<DynamicEDTOctomapBase<Tree>>(1.5F, &map_, point3d(-5.5F, -3.6F, -1.4F),
                                                         point3d(5.6F, 3.7F, 1.6F), unknown_occupied);
    edt_->update();
  }

  void updateCells(Dice& dice, int n) {
    for (int i = 0; i < n; ++i) {
      const point3d p = dice.point(4);
      const point3d near(p.x(), p.y() * 0.5F, p.z() * 0.3F);
      map_.updateNode(near, dice.below(5) == 0);
    }
    edt_->update();
  }
  void insertScan(Dice& dice) {
    const point3d origin(dice.between(-3, 3), dice.between(-2, 2), 0);
    map_.insertPointCloud(roomScan(origin, 3000, dice), origin);
    if (edt_) edt_->update();
  }

  Tree& map() { return map_; }
  const DynamicEDTOctomapBase<Tree>& edt() const { return *edt_; }

 private:
  Tree map_;
  std::unique_ptr<DynamicEDTOctomapBase<Tree>> edt_;
};

/// Whether unknown cells count as obstacles.
class DynamicEdt : public ::testing::TestWithParam<bool> {
 protected:
  Distances<octomap::OcTree> stock_{GetParam()};
  Distances<OcTree> ours_{GetParam()};

  /// Many points, some of them outside.
  void expectSameDistances() {
    EXPECT_TRUE(ours_.edt().checkConsistency());
    EXPECT_EQ(ours_.edt().getMaxDist(), stock_.edt().getMaxDist());
    Dice dice(22);
    int near = 0, clear = 0;
    for (int i = 0; i < 20000; ++i) {
      const point3d wide = dice.point(6);
      const point3d p(wide.x(), wide.y() * 0.65F, wide.z() * 0.3F);
      const float distance = stock_.edt().getDistance(p);
      ASSERT_EQ(ours_.edt().getDistance(p), distance) << p;
      const OcTreeKey key = ours_.map().coordToKey(p);
      ASSERT_EQ(ours_.edt().getDistance(key), stock_.edt().getDistance(key)) << p;
      ASSERT_EQ(ours_.edt().getSquaredDistanceInCells(p), stock_.edt().getSquaredDistanceInCells(p)) << p;

      float ours = -2, expected = -2;
      point3d our_obstacle(0, 0, 9), obstacle(0, 0, 9);
      ours_.edt().getDistanceAndClosestObstacle(p, ours, our_obstacle);
      stock_.edt().getDistanceAndClosestObstacle(p, expected, obstacle);
      ASSERT_EQ(ours, expected) << p;
      // Of obstacles at the same distance, the order of changes decides which one it is.
      const point3d centre = ours_.map().keyToCoord(key);
      if (expected >= 0 && expected < stock_.edt().getMaxDist()) {
        ASSERT_NEAR((our_obstacle - centre).norm(), (obstacle - centre).norm(), 1e-5) << p;
      }
      near += distance == 0;
      clear += distance > 0.25F;
    }
    EXPECT_GT(near, 100);
    EXPECT_GT(clear, 100);
  }
};

TEST_P(DynamicEdt, GivesTheDistancesOfTheSameMap) { expectSameDistances(); }

TEST_P(DynamicEdt, FollowsUpdatesOfCells) {
  Dice our_dice(23), dice(23);
  for (int round = 0; round < 10; ++round) {
    ours_.updateCells(our_dice, 200);
    stock_.updateCells(dice, 200);
    expectSameDistances();
    if (HasFatalFailure()) return;
  }
}

TEST_P(DynamicEdt, FollowsScans) {
  Dice our_dice(24), dice(24);
  for (int round = 0; round < 3; ++round) {
    ours_.insertScan(our_dice);
    stock_.insertScan(dice);
    expectSameDistances();
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Room, DynamicEdt, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "UnknownIsOccupied" : "UnknownIsFree"; });

}  // namespace
}  // namespace rhmap::test
