// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/shape.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "rhmap/sim/random.hpp"
#include "surface.hpp"

namespace rhmap::sim::test {
namespace {

using Eigen::Vector3d;

const std::vector<Shape> kShapes{Box{{1, 0.5, 0.8}}, Cylinder{0.6, 1.1}, Capsule{0.4, 0.7}, Ellipsoid{{1, 0.6, 0.9}}};

TEST(Shape, MeetsTheFacesOfABox) {
  const Shape box = Box{{1, 2, 3}};
  EXPECT_DOUBLE_EQ(hitDistance(box, {-5, 0, 0}, {1, 0, 0}), 4);
  EXPECT_DOUBLE_EQ(hitDistance(box, {0, 5, 0}, {0, -1, 0}), 3);
  EXPECT_DOUBLE_EQ(hitDistance(box, {0, 0, -7}, {0, 0, 1}), 4);
  EXPECT_EQ(hitDistance(box, {-5, 2.01, 0}, {1, 0, 0}), kNoHit);
  EXPECT_EQ(hitDistance(box, {-5, 0, 0}, {-1, 0, 0}), kNoHit) << "behind the ray";
}

TEST(Shape, MeetsMantleAndCapsOfACylinder) {
  const Shape cylinder = Cylinder{0.5, 2};
  EXPECT_DOUBLE_EQ(hitDistance(cylinder, {-3, 0, 1.9}, {1, 0, 0}), 2.5);
  EXPECT_DOUBLE_EQ(hitDistance(cylinder, {0.2, 0.1, 5}, {0, 0, -1}), 3);
  EXPECT_EQ(hitDistance(cylinder, {-3, 0, 2.1}, {1, 0, 0}), kNoHit);
}

TEST(Shape, MeetsTheEndsOfACapsule) {
  const Shape capsule = Capsule{0.25, 0.625};
  EXPECT_DOUBLE_EQ(hitDistance(capsule, {0, 0, 3}, {0, 0, -1}), 3 - 0.875);
  EXPECT_DOUBLE_EQ(hitDistance(capsule, {-2, 0, 0}, {1, 0, 0}), 1.75);
  EXPECT_NEAR(hitDistance(capsule, {-2, 0, 0.775}, {1, 0, 0}), 1.8, 1e-12) << "3-4-5: 0.15 up the cap";
}

TEST(Shape, MeetsAnEllipsoidWhereItsAxesEnd) {
  const Shape ellipsoid = Ellipsoid{{1, 2, 3}};
  EXPECT_DOUBLE_EQ(hitDistance(ellipsoid, {-5, 0, 0}, {1, 0, 0}), 4);
  EXPECT_DOUBLE_EQ(hitDistance(ellipsoid, {0, -5, 0}, {0, 1, 0}), 3);
  EXPECT_DOUBLE_EQ(hitDistance(ellipsoid, {0, 0, 5}, {0, 0, -1}), 2);
}

TEST(Shape, ARayThatStartsInsideHasMetIt) {
  for (const Shape& shape : kShapes) EXPECT_EQ(hitDistance(shape, {0.1, 0.1, 0.1}, {0, 1, 0}), 0);
}

/// Small steps along the ray find the first point inside, too.
TEST(Shape, AgreesWithWalkingAlongTheRay) {
  constexpr double kStep = 2e-3;
  Random random(3, 0);
  int hits = 0, misses = 0;
  for (const Shape& shape : kShapes) {
    for (int i = 0; i < 300; ++i) {
      const Vector3d origin = Vector3d(random.normal(), random.normal(), random.normal()).normalized() * 3;
      const Vector3d aim(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const Vector3d direction = (aim - origin).normalized();
      const double hit = hitDistance(shape, origin, direction);
      double walked = 0;
      while (walked < 6 && surfaceDistance(shape, origin + walked * direction) > 0) walked += kStep;
      if (walked < 6) {
        EXPECT_LE(hit, walked + 1e-9);
        EXPECT_GE(hit, walked - kStep - 1e-9);
        ++hits;
      } else if (hit != kNoHit) {  // steps may jump over a corner, and over no more
        EXPECT_NEAR(surfaceDistance(shape, origin + hit * direction), 0, 1e-9);
      } else {
        ++misses;
      }
    }
  }
  EXPECT_GT(hits, 300);
  EXPECT_GT(misses, 100);
}

}  // namespace
}  // namespace rhmap::sim::test
