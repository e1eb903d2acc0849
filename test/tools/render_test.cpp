// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/render/image.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "program.hpp"

namespace rhmap::test {
namespace {

struct RenderTest : ProgramTest {
  render::Image picture(const std::string& name) const { return render::readPng(folder / name); }

  template <class Test>
  static double share(const render::Image& image, Test&& test) {
    return double(std::count_if(image.pixels.begin(), image.pixels.end(), test)) / double(image.pixels.size());
  }
  static bool isRed(const render::Colour& c) { return c.r > c.g + 60 && c.r > c.b + 60; }
  static bool isPaper(const render::Colour& c) { return c.r > 240 && c.g > 240 && c.b > 240; }
};

TEST_F(RenderTest, DrawsAMapAndDrawsItTheSameAgain) {
  runs("render data/maps/geb079.bt map.png --size 320x200");
  const render::Image image = picture("map.png");
  EXPECT_EQ(image.width, 320);
  EXPECT_EQ(image.height, 200);
  EXPECT_GT(share(image, [](const auto& c) { return !isPaper(c); }), 0.1);
  EXPECT_GT(share(image, isPaper), 0.2);
  runs("render data/maps/geb079.bt again.png --size 320x200");
  EXPECT_EQ(bytes("map.png"), bytes("again.png"));
}

TEST_F(RenderTest, ShowsWhatIsLeftOfWhatMovedInRed) {
  const auto redOf = [this](const std::string& scene) {
    runs("simulate " + scene + " " + scene + " --beams 16 --frames 4");
    runs("clean " + scene + " map.bt --profile fast --front-end-only");  // nothing has moved away yet
    runs("render map.bt map.png --labels " + scene + " --size 400x300 --view top --box -20,-15,-2,40,15,2 --bare");
    return share(picture("map.png"), isRed);
  };
  EXPECT_GT(redOf("street"), 0.001);
  EXPECT_EQ(redOf("static"), 0);
}

TEST_F(RenderTest, TellsTheGroundFromWhatStandsOnIt) {
  runs("simulate street street --beams 32 --frames 3");
  runs("clean street map.bt --resolution 0.2 --max-range 30");
  runs("render map.bt ground.png --ground street --size 400x300 --view top --bare");
  const render::Image image = picture("ground.png");
  const double brown = share(image, [](const auto& c) { return c.r > c.b + 25; });
  const double blue = share(image, [](const auto& c) { return c.b > c.r + 25; });
  EXPECT_GT(brown, 0.02);
  EXPECT_GT(blue, 0.005);
}

TEST_F(RenderTest, TurnsAroundAMap) {
  runs("render data/maps/geb079.bt turn.png --turntable 2 --size 160x100");
  EXPECT_TRUE(exists("turn-0000.png"));
  EXPECT_TRUE(exists("turn-0001.png"));
  EXPECT_FALSE(exists("turn-0002.png"));
  EXPECT_NE(bytes("turn-0000.png"), bytes("turn-0001.png"));
}

TEST_F(RenderTest, SaysWhatIsWrong) {
  Outcome outcome = rhmap("render nothing.bt map.png");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, testing::HasSubstr("nothing.bt"));
  outcome = rhmap("render data/maps/geb079.bt map.jpg");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, testing::HasSubstr(".png"));
  EXPECT_FALSE(exists("map.jpg"));
}

}  // namespace
}  // namespace rhmap::test
