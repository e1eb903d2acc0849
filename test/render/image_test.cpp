// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/render/image.hpp"

#include "../test_files.hpp"

namespace rhmap::render {
namespace {

Image gradient() {
  Image image(7, 5, {});
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) image.at(x, y) = {std::uint8_t(30 * x), std::uint8_t(50 * y), std::uint8_t(x + y)};
  return image;
}

TEST(Image, ComesBackFromItsFile) {
  const test::TempFolder folder;
  const Image image = gradient();
  writePng(folder / "a.png", image);
  const Image back = readPng(folder / "a.png");
  EXPECT_EQ(back.width, 7);
  EXPECT_EQ(back.height, 5);
  EXPECT_TRUE(back.pixels == image.pixels);
}

TEST(Image, HasTheSameBytesForTheSamePicture) { EXPECT_EQ(encodePng(gradient()), encodePng(gradient())); }

TEST(Image, NamesAFileThatIsNoPicture) {
  const test::TempFolder folder;
  test::writeText(folder / "a.png", "no picture");
  test::expectMessage(test::messageOf([&] { readPng(folder / "a.png"); }), {"a.png"});
  test::expectMessage(test::messageOf([&] { writePng(folder / "none" / "a.png", gradient()); }), {"a.png"});
}

TEST(Colour, RampGoesFromBlueToOrangeAndStopsThere) {
  EXPECT_EQ(rampColour(-1), rampColour(0));
  EXPECT_EQ(rampColour(2), rampColour(1));
  EXPECT_GT(rampColour(0).b, rampColour(0).r);
  EXPECT_GT(rampColour(1).r, rampColour(1).b);
}

TEST(Colour, MixesChannelByChannel) {
  EXPECT_EQ(mix({0, 100, 200, 0}, {100, 0, 200}, 0.5), (Colour{50, 50, 200, 128}));
}

}  // namespace
}  // namespace rhmap::render
