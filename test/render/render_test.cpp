// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <stdexcept>

#include "rhmap/octree/color_octree.hpp"
#include "rhmap/octree/octree.hpp"
#include "rhmap/render/colouring.hpp"
#include "rhmap/render/scene.hpp"

namespace rhmap::render {
namespace {

using Eigen::Vector3d;

constexpr PictureConfig kSmall{.width = 120, .height = 90};
constexpr double kAspect = 120. / 90;
constexpr Colour kRed{200, 0, 0};

/// One cell of 1 m with its corner at the origin.
FaceMesh oneCube(Colour colour) {
  OcTree tree(1.0);
  tree.updateNode(0.5, 0.5, 0.5, true);
  return occupiedFaces(tree, [colour](const auto&) { return colour; });
}

const Colour& pixelAt(const Image& image, const Camera& camera, const Vector3d& point) {
  const Eigen::Vector2d pixel = *Projection(camera, image.width, image.height).toPixel(point);
  return image.at(int(pixel.x()), int(pixel.y()));
}

double coverage(const Image& image, Colour background) {
  std::size_t covered = 0;
  for (const Colour& pixel : image.pixels) covered += pixel != background;
  return double(covered) / double(image.pixels.size());
}

TEST(Render, ACubeIsWhereItIsInItsColour) {
  const Scene scene{.solids = {oneCube(kRed)}};
  const Camera camera = topView(boundsOf(scene), kAspect);
  const Image image = render(scene, camera, kSmall);
  EXPECT_EQ(pixelAt(image, camera, {0.5, 0.5, 1}), kRed);  // its upper side is fully lit
  EXPECT_EQ(pixelAt(image, camera, {-0.1, 0.5, 0}), kSmall.background);
  // A square that is as high as the picture but for the margin.
  const double side = Projection(camera, 120, 90).pixelsPerMetre();
  EXPECT_NEAR(coverage(image, kSmall.background), side * side / (120 * 90), 0.02);
}

TEST(Render, SidesDifferInLight) {
  const Scene scene{.solids = {oneCube(kRed)}};
  const Camera camera = isometricView(boundsOf(scene), kAspect);
  const Image image = render(scene, camera, kSmall);
  const Colour above = pixelAt(image, camera, {0.5, 0.5, 1});
  const Colour left = pixelAt(image, camera, {0, 0.5, 0.5});
  const Colour right = pixelAt(image, camera, {0.5, 0, 0.5});
  EXPECT_GT(above.r, left.r);
  EXPECT_GT(left.r, right.r);
  EXPECT_GT(right.r, 80);
  EXPECT_EQ(right.g, 0);
}

TEST(Render, WhatIsNearHidesWhatIsFar) {
  OcTree tree(1.0);
  tree.updateNode(0.5, 0.5, 0.5, true);
  tree.updateNode(0.5, 0.5, 3.5, true);
  const Scene scene{.solids = {occupiedFaces(tree, [](const auto& leaf) {
                      return leaf.getZ() > 2 ? Colour{0, 200, 0} : kRed;
                    })}};
  const Camera camera = topView(boundsOf(scene), kAspect);
  EXPECT_EQ(pixelAt(render(scene, camera, kSmall), camera, {0.5, 0.5, 0}), (Colour{0, 200, 0}));
}

TEST(Render, GlassTintsWhatIsBehindIt) {
  OcTree tree(1.0);
  tree.updateNode(0.5, 0.5, 0.5, true);
  tree.updateNode(0.5, 0.5, 1.5, false);
  const auto red = [](const auto&) { return kRed; };
  const Scene scene{.solids = {occupiedFaces(tree, red)}, .glass = {freeFaces(tree, {0, 0, 255, 128})}};
  const Camera camera = topView(boundsOf(scene), kAspect);
  const Colour tinted = pixelAt(render(scene, camera, kSmall), camera, {0.5, 0.5, 1});
  EXPECT_NEAR(tinted.r, 100, 3);
  EXPECT_NEAR(tinted.b, 128, 3);
}

TEST(Render, DrawsPointsAndTrajectories) {
  const Scene scene{.clouds = {{.points = {{0, 0, 0}, {4, 3, 0}}, .colours = {kRed, {0, 0, 200}}, .size = 5}},
                    .trajectories = {{.points = {{0, 3, 0}, {4, 0, 0}}, .colour = {0, 150, 0}, .width = 5}}};
  const Camera camera = topView(boundsOf(scene), kAspect);
  const Image image = render(scene, camera, kSmall);
  EXPECT_EQ(pixelAt(image, camera, {0, 0, 0}), kRed);
  EXPECT_EQ(pixelAt(image, camera, {4, 3, 0}), (Colour{0, 0, 200}));
  EXPECT_EQ(pixelAt(image, camera, {2, 1.5, 0}), (Colour{0, 150, 0}));
  EXPECT_LT(coverage(image, kSmall.background), 0.1);
}

TEST(Render, ColoursByHeightOccupancyAndTheTreesOwnColours) {
  ColorOcTree tree(1.0);
  tree.setNodeValue(0.5, 0.5, 0.5, 0.5F)->setColor(10, 200, 30);
  tree.setNodeValue(5.5, 0.5, 4.5, 3.4F)->setColor(200, 100, 30);
  const auto picked = [&](auto colouring, const Vector3d& at) {
    const Scene scene{.solids = {occupiedFaces(tree, colouring)}};
    const Camera camera = topView(boundsOf(scene), kAspect);
    return pixelAt(render(scene, camera, kSmall), camera, at);
  };
  const Vector3d low(0.5, 0.5, 1), high(5.5, 0.5, 5);
  EXPECT_EQ(picked(byOwnColour(), low), (Colour{10, 200, 30}));
  EXPECT_EQ(picked(byOwnColour(), high), (Colour{200, 100, 30}));
  EXPECT_EQ(picked(byHeight({0.5, 4.5}), low), rampColour(0));
  EXPECT_EQ(picked(byHeight({0.5, 4.5}), high), rampColour(1));
  EXPECT_EQ(picked(byOccupancy(), low), rampColour(2 * (octomap::probability(0.5) - 0.5)));
}

TEST(Render, IsTheSameForTheSameInput) {
  const Scene scene{.solids = {oneCube(kRed)}, .glass = {oneCube(kFreeSpace)}};
  const Camera camera = orbitView(boundsOf(scene), 1, 0.5, kAspect);
  EXPECT_TRUE(render(scene, camera, kSmall).pixels == render(scene, camera, kSmall).pixels);
}

TEST(Render, AnEmptySceneIsBackground) {
  const Image image = render({}, topView(boundsOf(Scene{}), kAspect), kSmall);
  EXPECT_EQ(coverage(image, kSmall.background), 0);
}

TEST(Render, GoesUpTo4k) {
  const Scene scene{.solids = {oneCube(kRed)}};
  const PictureConfig config{.width = 3840, .height = 2160};
  const Camera camera = topView(boundsOf(scene), 3840. / 2160);
  const Image image = render(scene, camera, config);
  EXPECT_EQ(pixelAt(image, camera, {0.5, 0.5, 1}), kRed);
  EXPECT_EQ(image.at(3839, 2159), config.background);
}

TEST(Render, NamesAWrongSize) {
  const Camera camera;
  EXPECT_THROW(render({}, camera, {.width = 0}), std::invalid_argument);
  EXPECT_THROW(render({}, camera, {.height = kMaxPictureSide + 1}), std::invalid_argument);
  EXPECT_THROW(render({}, camera, {.supersampling = 0}), std::invalid_argument);
  EXPECT_THROW(render({.clouds = {{.points = {{0, 0, 0}}, .colours = {}}}}, camera, kSmall), std::invalid_argument);
}

TEST(Colouring, HeightRangeLeavesOutBirdsAndPits) {
  OcTree tree(0.1);
  for (int i = 0; i < 200; ++i) tree.updateNode(0.1 * i + 0.05, 0.05, 0.05 + 0.01 * i, true);
  tree.updateNode(0.05, 0.05, 100., true);
  tree.updateNode(0.05, 0.05, -100., true);
  const Range range = heightRange(tree);
  EXPECT_NEAR(range.min, 0.05, 0.11);
  EXPECT_NEAR(range.max, 2.05, 0.11);
  EXPECT_LT(heightRange(tree, 1.0).max, 1.0);
}

}  // namespace
}  // namespace rhmap::render
