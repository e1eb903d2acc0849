// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "program.hpp"
#include "rhmap/render/image.hpp"

namespace rhmap::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kOptions = " --resolution 0.3 --max-range 30 --profile default";

/// Rows of a picture from the top, columns from the left, as shares of it.
struct Part {
  double left = 0, right = 1;
};

struct ReportTest : ProgramTest {
  std::string makeReport() const {
    runs("simulate street street --beams 16 --frames 16 --rate 2");
    return runs("report street -o page" + std::string(kOptions));
  }

  render::Image picture(const std::string& name) const { return render::readPng(folder / name); }

  /// How much of the part is red as what moved is.
  static double redOf(const render::Image& image, Part part = {}) {
    std::size_t red = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = int(part.left * image.width); x < int(part.right * image.width); ++x) {
        const render::Colour& c = image.at(x, y);
        red += c.r > 130 && c.r > 3 * c.g && c.r > 3 * c.b;
      }
    return double(red) / double(image.pixels.size());
  }

  /// A browser without a screen; the page's own time goes on until it has nothing left to do.
  Outcome browse(const std::string& options) const {
    return shell(
        "timeout 120 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
        "--disable-background-networking --disable-component-update --disable-sync --use-gl=angle "
        "--use-angle=swiftshader --enable-unsafe-swiftshader --user-data-dir=\"$PWD/profile\" "
        "--enable-logging=stderr --v=0 --hide-scrollbars --virtual-time-budget=3000 " +
        options);
  }

  /// What the page has said in the browser's console, save for what its graphics say of their own speed.
  static std::vector<std::string> consoleOf(const Outcome& outcome) {
    std::vector<std::string> said;
    std::istringstream lines(outcome.err);
    for (std::string line; std::getline(lines, line);)
      if (line.find("CONSOLE") != std::string::npos && line.find("GL Driver Message") == std::string::npos)
        said.push_back(line);
    return said;
  }
};

TEST_F(ReportTest, IsOnePageWithPicturesAndScoresThatNeedsNothingElse) {
  const std::string text = makeReport();
  for (const std::string name :
       {"index.html", "before.png", "octomap.png", "after.png", "difference.png", "comparison.json", "scans.csv"}) {
    EXPECT_TRUE(exists("page/" + name)) << name;
    EXPECT_THAT(text, HasSubstr("written   page/" + name));
  }
  const std::string page = bytes("page/index.html");
  for (const std::string part : {"src=\"http", "src='http", "href=", "<link", "@import", "url("})
    EXPECT_THAT(page.substr(0, page.find("<script")), Not(HasSubstr(part)));
  for (const std::string part :
       {"Protocol rhmap", "Protocol erasor", "Protocol kth", "<td>octomap</td>", "<td>octomap, ground kept</td>",
        "<td>rhmap default</td>", "Time of a scan [ms]", "Memory of the map [MB]", "identical"})
    EXPECT_THAT(page, HasSubstr(part));
  EXPECT_THAT(page, Not(HasSubstr("{{")));

  // And what moved is there before, and mostly gone after.
  const double before = redOf(picture("page/before.png")), after = redOf(picture("page/after.png"));
  EXPECT_GT(before, 0.005);
  EXPECT_LT(after, 0.6 * before);
}

TEST_F(ReportTest, ItsCommandsRun) {
  makeReport();
  const std::string page = bytes("page/index.html");
  const auto begin = page.find("<pre>") + 5;
  std::istringstream lines(page.substr(begin, page.find("</pre>") - begin));
  std::size_t commands = 0;
  for (std::string line; std::getline(lines, line); ++commands) {
    ASSERT_TRUE(line.starts_with("rhmap ")) << line;
    runs(line.substr(6));
  }
  EXPECT_EQ(commands, 4U);
}

TEST_F(ReportTest, OpensInABrowserAndDrawsBothMaps) {
  makeReport();
  const Outcome opened = browse("--dump-dom \"file://$PWD/page/index.html\"");
  ASSERT_EQ(opened.exit_code, 0) << opened.err;
  EXPECT_THAT(opened.out, HasSubstr("data-viewer=\"drawn\""));
  EXPECT_THAT(consoleOf(opened), testing::IsEmpty());

  // Nothing but the 3D view, so that its place does not hang on fonts.
  std::string page = bytes("page/index.html");
  page.insert(page.find("</style>"), "header, section:not(#space), h2 { display: none }");
  writeFile(folder / "view.html", page);
  const Outcome shot = browse("--window-size=1200,620 --screenshot=shot.png \"file://$PWD/view.html\"");
  ASSERT_EQ(shot.exit_code, 0) << shot.err;
  const render::Image image = picture("shot.png");
  const double left = redOf(image, {.left = 0, .right = 0.5}), right = redOf(image, {.left = 0.5, .right = 1});
  EXPECT_GT(left, 0.001);
  EXPECT_LT(right, left);
  const auto paper = std::count_if(image.pixels.begin(), image.pixels.end(),
                                   [](const render::Colour& c) { return c.r > 240 && c.g > 240 && c.b > 240; });
  EXPECT_LT(double(paper) / double(image.pixels.size()), 0.9);
}

TEST_F(ReportTest, SaysWhatIsWrong) {
  writeFile(folder / "file", "");
  EXPECT_EQ(rhmap("report data/maps/spherical_scan.graph").exit_code, 2);
  fails("report data/maps/spherical_scan.graph -o file", 1, "file: cannot be made a folder");
  fails("report nowhere -o page", 1, "nowhere: No such file");
}

}  // namespace
}  // namespace rhmap::test
