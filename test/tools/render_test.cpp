// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/render/image.hpp"

#include <fmt/format.h>
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

TEST_F(RenderTest, ShowsWhatACleanedMapKeptAndRemoved) {
  // Two walls, of which the other map has one.
  std::string left, right;
  for (int i = 0; i < 20; ++i) {
    left += fmt::format("0.05 {:.2f} 0.05\n", 0.1 * i + 0.05);
    right += fmt::format("2.05 {:.2f} 0.05\n", 0.1 * i + 0.05);
  }
  writeFile(folder / "both.xyz", left + right);
  writeFile(folder / "left.xyz", left);
  for (const std::string name : {"both", "left"}) runs("build " + name + ".xyz " + name + ".bt --resolution 0.1");
  runs("render both.bt moved.png --after left.bt --view top --size 210x200 --bare");
  const render::Image image = picture("moved.png");
  const double kept = share(image, [](const auto& c) { return c == render::kKept; });
  EXPECT_GT(kept, 0.02);
  EXPECT_NEAR(kept, share(image, [](const auto& c) { return c == render::kRemoved; }), 0.2 * kept);
  const auto columnOf = [&](const render::Colour& colour) {
    return (std::find(image.pixels.begin(), image.pixels.end(), colour) - image.pixels.begin()) % image.width;
  };
  EXPECT_LT(columnOf(render::kKept), 105);
  EXPECT_GT(columnOf(render::kRemoved), 105);
}

TEST_F(RenderTest, DrawsACloudByHeight) {
  std::string points;
  for (int i = 0; i < 1000; ++i) points += fmt::format("{} {} {}\n", i % 100, i / 100, i % 100 < 50 ? 0 : 3);
  writeFile(folder / "cloud.xyz", points);
  runs("render cloud.xyz cloud.png --view top --size 400x60 --bare");
  const render::Image image = picture("cloud.png");
  const auto left = [&](const render::Colour& colour) { return (&colour - image.pixels.data()) % image.width < 200; };
  EXPECT_GT(share(image, [&](const auto& c) { return c == render::rampColour(0) && left(c); }), 0.03);
  EXPECT_GT(share(image, [&](const auto& c) { return c == render::rampColour(1) && !left(c); }), 0.03);
  EXPECT_EQ(share(image, [&](const auto& c) { return c == render::rampColour(1) && left(c); }), 0);
}

TEST_F(RenderTest, DrivesAlongAPath) {
  runs("simulate street street --beams 16 --frames 4");
  runs("build street street.bt --resolution 0.4 --max-range 30");
  runs("render street.bt drive.png --path street --drive 2 --size 160x100 --bare");
  const auto isPath = [](const render::Colour& c) { return c == render::kTrajectory; };
  EXPECT_GT(share(picture("drive-0000.png"), isPath), 0.0005);
  EXPECT_TRUE(exists("drive-0001.png"));
  EXPECT_FALSE(exists("drive-0002.png"));
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
  fails("render data/maps/geb079.bt map.png --drive 3", 2, "--path SEQUENCE is missing; it is what is driven along");
  fails("render data/maps/geb079.bt map.png --eye 1,2,3", 2, "--eye and --target go together");
  fails("render data/maps/geb079.bt map.png --colour height --after data/maps/geb079.bt", 2,
        "--colour does not go with --after, --labels and --ground, which have colours of their own");
}

}  // namespace
}  // namespace rhmap::test
