// SPDX-License-Identifier: BSD-3-Clause
#include <octomap/OcTree.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace rhmap::test {
namespace {

struct InfoTest : ProgramTest {};

TEST_F(InfoTest, TellsWhatOctomapReads) {
  octomap::OcTree expected(dataFile("maps/geb079.bt"));
  const auto info = nlohmann::json::parse(runs("info data/maps/geb079.bt --json -"));
  EXPECT_EQ(info["format"], "bt");
  EXPECT_EQ(info["id"], "OcTree");
  EXPECT_EQ(info["resolution_m"], 0.08);
  EXPECT_EQ(info["file_bytes"], 208986);
  EXPECT_EQ(info["header_size"], 532566);
  EXPECT_EQ(info["nodes"], 532566);
  EXPECT_EQ(info["leaves"], 428144);
  EXPECT_EQ(info["octomap_memory_estimate_bytes"], expected.memoryUsage());

  std::size_t occupied = 0;
  double volume = 0;
  for (auto leaf = expected.begin_leafs(); leaf != expected.end_leafs(); ++leaf) {
    if (!expected.isNodeOccupied(*leaf)) continue;
    ++occupied;
    volume += leaf.getSize() * leaf.getSize() * leaf.getSize();
  }
  EXPECT_EQ(info["occupied_leaves"], occupied);
  EXPECT_EQ(info["free_leaves"], 428144 - occupied);
  EXPECT_NEAR(info["occupied_volume_m3"], volume, 1e-9);

  double x = 0, y = 0, z = 0;
  expected.getMetricMin(x, y, z);
  EXPECT_EQ(info["min_m"], nlohmann::json({x, y, z}));
  expected.getMetricMax(x, y, z);
  EXPECT_EQ(info["max_m"], nlohmann::json({x, y, z}));
}

TEST_F(InfoTest, CountsEveryLeafAtOneDepth) {
  const auto info = nlohmann::json::parse(runs("info data/maps/geb079.bt --json -"));
  std::size_t leaves = 0;
  for (const auto& level : info["leaves_by_depth"])
    leaves += level["occupied"].get<std::size_t>() + level["free"].get<std::size_t>();
  EXPECT_EQ(info["leaves"], leaves);
}

TEST_F(InfoTest, WritesTheSameFiguresForPeopleAndForPrograms) {
  const std::string text = runs("info data/maps/geb079.bt --json info.json");
  EXPECT_NE(text.find("nodes       532,566, the header says 532,566\n"), std::string::npos) << text;
  EXPECT_NE(text.find("resolution  0.08 m\n"), std::string::npos) << text;
  EXPECT_EQ(nlohmann::json::parse(bytes("info.json"))["nodes"], 532566);
}

TEST_F(InfoTest, ReadsAnEmptyMap) {
  for (const std::string map : {"data/golden/empty.bt", "data/golden/empty.ot"})
    EXPECT_EQ(nlohmann::json::parse(runs("info " + map + " --json -"))["nodes"], 0);
}

TEST_F(InfoTest, ReadsTheBtOfAColorTree) {
  EXPECT_EQ(nlohmann::json::parse(runs("info data/golden/one_color.bt --json -"))["id"], "ColorOcTree");
}

TEST_F(InfoTest, ReadsTheOtOfColoursAndTimes) {
  for (const std::string type : {"one_color", "one_stamped"}) {
    const auto json = nlohmann::json::parse(runs("info data/golden/" + type + ".ot --json -"));
    EXPECT_EQ(json["id"], type == "one_color" ? "ColorOcTree" : "OcTreeStamped");
    EXPECT_EQ(json["occupied_leaves"], 1);
  }
}

TEST_F(InfoTest, GoesByTheFirstLineAndNotByTheExtension) {
  std::filesystem::copy_file(dataFile("golden/one_hit.ot"), folder / "renamed.bt");
  EXPECT_EQ(nlohmann::json::parse(runs("info renamed.bt --json -"))["format"], "ot");
}

TEST_F(InfoTest, NamesTheTreesThatItKnowsWhenTheOtIsOfAnother) {
  fails("info data/golden/one_counting.ot", 1,
        "data/golden/one_counting.ot: .ot files of the type OcTreeBase cannot be read; one of: OcTree, ColorOcTree, "
        "OcTreeStamped");
}

TEST_F(InfoTest, AMissingFileIsOneLine) { fails("info nowhere.bt", 1, "nowhere.bt: No such file"); }

TEST_F(InfoTest, RefusesWhatIsNoMapWithOneLine) {
  writeFile(folder / "empty.bt", "");
  writeFile(folder / "text.bt", "no map\n");
  writeFile(folder / "header.bt", "# Octomap OcTree binary file\nid OcTree\nsize 1\nres 0.1\n");
  writeFile(folder / "resolution.ot", "# Octomap OcTree file\nid OcTree\nsize 1\nres -0.1\ndata\n");
  for (const std::string name : {"empty.bt", "text.bt", "header.bt", "resolution.ot", "data"}) {
    const Outcome outcome = rhmap("info " + name);
    EXPECT_EQ(outcome.exit_code, 1) << name;
    EXPECT_TRUE(outcome.err.starts_with("rhmap: " + name + ": ")) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  }
}

TEST_F(InfoTest, AnOutputThatTakesNothingIsAFailure) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const Outcome outcome = shell("'" RHMAP_PROGRAM "' info data/golden/one_hit.bt >/dev/full");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err, "rhmap: standard output cannot be written\n");
}

}  // namespace
}  // namespace rhmap::test
