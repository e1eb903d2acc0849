// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/render/caption.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace rhmap::render {
namespace {

constexpr Colour kWhite{255, 255, 255};
const Box kBox(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(100, 100, 10));

Image blank() { return Image(640, 400, kWhite); }

std::size_t count(const Image& image, Colour colour) {
  return std::size_t(std::count(image.pixels.begin(), image.pixels.end(), colour));
}

TEST(Caption, LengthsAreRound) {
  EXPECT_DOUBLE_EQ(roundLength(7.3), 5);
  EXPECT_DOUBLE_EQ(roundLength(4.9), 2);
  EXPECT_DOUBLE_EQ(roundLength(1), 1);
  EXPECT_DOUBLE_EQ(roundLength(0.034), 0.02);
  EXPECT_DOUBLE_EQ(roundLength(199), 100);
}

TEST(Caption, ScaleBarIsAsLongAsItSays) {
  Image image = blank();
  const Camera camera = topView(kBox, 1.6);
  drawCaption(image, camera, {.axes = false});
  const Colour ink{38, 42, 48};
  // The bar's lowest row is the last one with ink.
  int bar = 0;
  for (int y = 0; y < image.height; ++y) {
    const auto row = image.pixels.begin() + std::ptrdiff_t(y) * image.width;
    if (const auto n = std::count(row, row + image.width, ink); n > 0) bar = int(n);
  }
  const double scale = Projection(camera, 640, 400).pixelsPerMetre();
  EXPECT_NEAR(bar, scale * roundLength(0.2 * 640 / scale), 1);
}

TEST(Caption, LegendShowsItsColours) {
  Image image = blank();
  drawCaption(image, topView(kBox, 1.6),
              {.title = "A title, Überschrift", .entries = {{kMissed, "missed"}}, .ramps = {{"height", "m", {0, 3}}}});
  EXPECT_GE(count(image, kMissed), 50U);
  EXPECT_GE(count(image, rampColour(0)), 5U);
  EXPECT_GE(count(image, rampColour(1)), 5U);
}

TEST(Caption, EveryLetterOfTheTitleIsWritten) {
  const auto ink = [](const std::string& title) {
    Image image = blank();
    drawCaption(image, topView(kBox, 1.6), {.title = title, .scale_bar = false, .axes = false});
    return image.pixels.size() - count(image, kWhite);
  };
  EXPECT_EQ(ink(""), 0U);
  EXPECT_GT(ink("i"), 3U);
  EXPECT_GT(ink("ii"), ink("i"));
  EXPECT_GT(ink("\xff broken"), 0U);  // bytes that are no UTF-8
}

TEST(Caption, AxesThatPointAtTheViewerAreNotDrawn) {
  Image image = blank();
  drawCaption(image, topView(kBox, 1.6), {.scale_bar = false});
  EXPECT_GT(count(image, {206, 52, 52}), 10U);  // x
  EXPECT_GT(count(image, {44, 150, 70}), 10U);  // y
  EXPECT_EQ(count(image, {52, 92, 210}), 0U);   // z
}

TEST(Caption, FitsIntoTheSmallestPicture) {
  Image image(1, 1, kWhite);
  drawCaption(image, topView(kBox, 1), {.title = "long", .entries = {{kKept, "kept"}}});
  EXPECT_EQ(image.pixels.size(), 1U);
}

}  // namespace
}  // namespace rhmap::render
