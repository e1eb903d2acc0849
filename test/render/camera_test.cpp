// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/render/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace rhmap::render {
namespace {

using Eigen::Vector3d;

const Box kBox(Vector3d(10, -4, -1), Vector3d(50, 6, 3));
constexpr int kWidth = 320, kHeight = 200;
constexpr double kAspect = double(kWidth) / kHeight;

TEST(Camera, FitsTheWholeBoxIntoThePicture) {
  std::vector<Camera> cameras{topView(kBox, kAspect), isometricView(kBox, kAspect)};
  for (int i = 0; i < 8; ++i) cameras.push_back(orbitView(kBox, i * 0.8, 0.5, kAspect));
  for (const Camera& camera : cameras) {
    const Projection projection(camera, kWidth, kHeight);
    Eigen::AlignedBox2d used;
    for (int i = 0; i < 8; ++i) {
      const auto pixel = projection.toPixel(kBox.corner(static_cast<Box::CornerType>(i)));
      ASSERT_TRUE(pixel);
      used.extend(*pixel);
    }
    EXPECT_GE(used.min().minCoeff(), 0);
    EXPECT_LE(used.max().x(), kWidth);
    EXPECT_LE(used.max().y(), kHeight);
    // And not smaller than it must be.
    EXPECT_GT(std::max(used.sizes().x() / kWidth, used.sizes().y() / kHeight), 0.75);
  }
}

TEST(Camera, TopViewHasXToTheRightAndYUpAtOneScale) {
  const Projection projection(topView(kBox, kAspect), kWidth, kHeight);
  const Eigen::Vector2d middle = *projection.toPixel(kBox.center());
  EXPECT_NEAR(middle.x(), kWidth / 2., 1e-9);
  EXPECT_NEAR(middle.y(), kHeight / 2., 1e-9);
  const double scale = projection.pixelsPerMetre();
  EXPECT_NEAR((*projection.toPixel(kBox.center() + Vector3d::UnitX()) - middle).x(), scale, 1e-9);
  EXPECT_NEAR((*projection.toPixel(kBox.center() + Vector3d::UnitY()) - middle).y(), -scale, 1e-9);
}

TEST(Camera, PerspectiveSeesNothingBehindTheEye) {
  const Projection projection(lookAt({0, 0, 0}, {1, 0, 0}), kWidth, kHeight);
  EXPECT_TRUE(projection.toPixel({2, 0, 0}));
  EXPECT_FALSE(projection.toPixel({-2, 0, 0}));
}

TEST(Camera, ScaleIsThatAtTheTarget) {
  const Projection projection(lookAt({0, 0, 5}, {20, 0, 5}), kWidth, kHeight);
  const double metre = (*projection.toPixel({20, 1, 5}) - *projection.toPixel({20, 0, 5})).norm();
  EXPECT_NEAR(projection.pixelsPerMetre(), metre, 1e-9);
}

TEST(Camera, ClipMatrixAgreesWithThePixels) {
  for (const Camera& camera : {orbitView(kBox, 1, 0.4, kAspect), isometricView(kBox, kAspect)}) {
    const Projection projection(camera, kWidth, kHeight);
    for (const Vector3d& point : {Vector3d(20, 0, 0), Vector3d(45, 5, 2)}) {
      const Vector3d seen = viewOf(camera) * point;
      const Eigen::Vector4d clip = projection.clipMatrix(0.1, 500) * seen.homogeneous();
      const Eigen::Vector2d pixel = *projection.toPixel(point);
      EXPECT_NEAR((clip.x() / clip.w() + 1) / 2 * kWidth, pixel.x(), 1e-6);
      EXPECT_NEAR((1 - clip.y() / clip.w()) / 2 * kHeight, pixel.y(), 1e-6);
      EXPECT_LT(std::abs(clip.z() / clip.w()), 1);
    }
  }
}

TEST(Camera, DrivesAlongThePathInTheDirectionOfTravel) {
  const std::vector<Vector3d> path{{0, 0, 1}, {30, 0, 1}, {30, 30, 1}};
  const Camera start = alongPath(path, 0);
  EXPECT_LT(start.eye.x(), 0);
  EXPECT_GT(start.target.x(), 0);
  const Camera end = alongPath(path, 1);
  EXPECT_LT(end.eye.y(), 30);
  EXPECT_GT(end.target.y(), 30);
  EXPECT_NEAR(end.target.x(), 30, 1e-9);
}

TEST(Camera, StandsStillWhereThePathDoes) {
  const std::vector<Vector3d> path{{1, 2, 3}, {1, 2, 3}};
  EXPECT_NEAR(alongPath(path, 0.5).target.y(), 2, 1e-9);
  EXPECT_THROW(alongPath({}, 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace rhmap::render
