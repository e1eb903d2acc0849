// SPDX-License-Identifier: BSD-3-Clause
#include <octomap/OcTree.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace rhmap::test {
namespace {

struct CleanTest : ProgramTest {
  CleanTest() { runs("simulate street street --beams 16 --frames 20"); }

  nlohmann::json summary(const std::string& arguments) const {
    return nlohmann::json::parse(runs("clean street " + arguments + " --json -"));
  }

  /// PR and RR of a map as protocol rhmap sees them.
  nlohmann::json cells(const std::string& map) const {
    return nlohmann::json::parse(runs("evaluate street --protocol rhmap --json - --map " + map))["rows"][2]["cells"];
  }
};

TEST_F(CleanTest, TakesOutWhatMovesAndKeepsTheRest) {
  runs("clean street clean.bt");

  const auto clean = cells("clean.bt");
  EXPECT_GT(clean["static"], 100000);
  EXPECT_GT(clean["PR"], 0.98);
  EXPECT_GT(clean["RR"], 0.7);
}

TEST_F(CleanTest, FilesHoldTheSameCells) {
  const auto json = summary("clean.bt clean.ot clean.ply clean.pcd");
  ASSERT_EQ(json["files"].size(), 4U);
  const auto cubes = json["occupied_cubes"].get<std::size_t>();
  for (const auto& [map, is_binary] : {std::pair("clean.bt", true), std::pair("clean.ot", false)}) {
    std::unique_ptr<octomap::AbstractOcTree> read;
    octomap::OcTree binary(0.1);
    if (is_binary) {
      ASSERT_TRUE(binary.readBinary((folder / map).string()));
    } else {
      read.reset(octomap::AbstractOcTree::read((folder / map).string()));
    }
    auto& tree = is_binary ? binary : dynamic_cast<octomap::OcTree&>(*read);
    tree.expand();
    std::size_t occupied = 0;
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) occupied += tree.isNodeOccupied(*leaf);
    EXPECT_EQ(occupied, cubes) << map;
  }
  const std::string number = std::to_string(cubes);
  EXPECT_NE(bytes("clean.ply").find("element vertex " + number + "\n"), std::string::npos);
  EXPECT_NE(bytes("clean.pcd").find("POINTS " + number + "\n"), std::string::npos);
}

TEST_F(CleanTest, SummarisesForPrograms) {
  const auto json = summary("clean.bt --frames 5-14 --max-range 40");
  EXPECT_EQ(json["sequence"], "street");
  EXPECT_EQ(json["first_scan"], 5);
  EXPECT_EQ(json["last_scan"], 14);
  EXPECT_EQ(json["profile"], "default");
  EXPECT_EQ(json["resolution_m"], 0.1);
  EXPECT_EQ(json["region_size"], 8);
  EXPECT_EQ(json["free_space"], false);
  EXPECT_EQ(json["back_end"], true);
  EXPECT_EQ(json["min_range_m"], 2.7);
  EXPECT_EQ(json["max_range_m"], 40);
  EXPECT_EQ(json["scans"], 10);
  EXPECT_GT(json["points"], 100000);
  EXPECT_GT(json["dropped_points"], 1000);
  EXPECT_GT(json["inserted_cubes"], json["occupied_cubes"]);
  EXPECT_TRUE(json.contains("rejected_cubes"));
  EXPECT_GT(json["removed_cubes"], 0);
  EXPECT_GT(json["keyframes"], 0);
  EXPECT_GT(json["median_scan_s"], 0);
  EXPECT_GT(json["mean_scan_s"], 0);
  EXPECT_EQ(json["scan_s"].size(), 10U);
  EXPECT_EQ(json["removal_bytes_each_50_scans"].size(), 0U);
  double stages = 0;
  for (const auto& [stage, seconds] : json["median_stage_s"].items()) stages += seconds.get<double>();
  EXPECT_NEAR(stages, json["median_scan_s"], 0.5 * stages);
}

TEST_F(CleanTest, SummarisesForPeople) {
  const std::string text = runs("clean street clean.bt --frames 0-4 --profile fast --json summary.json");
  for (const std::string part : {"sequence  street, scans 0-4\n",
                                 "settings  profile fast, resolution 0.1 m, regions of 8 cubes, range 2.7 m to any",
                                 "scans     5\n", " dropped\n", " rejected, ", " removed, ", "time per scan, median",
                                 "  regions ", " ms\n", "written   clean.bt ("})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(nlohmann::json::parse(bytes("summary.json"))["profile"], "fast");
}

TEST_F(CleanTest, OptionsReachTheMap) {
  const auto plain = summary("clean.bt --frames 0-9");
  EXPECT_EQ(summary("front.bt --frames 0-9 --front-end-only")["keyframes"], 0);
  EXPECT_LT(summary("coarse.bt --frames 0-9 --resolution 0.2")["occupied_cubes"], plain["occupied_cubes"]);
  EXPECT_EQ(summary("paper.bt --frames 0-9 --profile paper")["rejected_cubes"], 0);
  EXPECT_LT(summary("far.bt --frames 0-9 --min-range 8")["points"], plain["points"]);
  EXPECT_EQ(summary("large.bt --frames 0-9 --region-size 16")["region_size"], 16);
  EXPECT_NE(bytes("large.bt"), bytes("clean.bt"));
}

TEST_F(CleanTest, GivesTheSameBytesTwice) {
  runs("clean street once.ot --frames 0-9");
  runs("clean street twice.ot --frames 0-9");
  EXPECT_TRUE(bytes("once.ot") == bytes("twice.ot"));
}

TEST_F(CleanTest, WrongWordsAreAnsweredWithTheRightOnes) {
  const std::string help = "; see rhmap clean --help";
  fails("clean street map.bt --profile best", 2,
        "--profile: best is not a profile; one of: paper, fast, default" + help);
  fails("clean street map.bt --region-size 5", 2, "--region-size: 5 is not a region size; one of: 4, 8, 16" + help);
  fails("clean street map.bt --free-space maybe", 2, "--free-space: maybe is not a switch; one of: on, off" + help);
  fails("clean street map.xyz", 2, "MAP: map.xyz has no known extension; one of: .bt, .ot, .ply, .pcd" + help);
  fails("clean street no/map.bt", 2, "MAP: no/map.bt: there is no folder no" + help);
  fails("clean street map.bt --frames 0-20", 2, "--frames: 0-20 is not in the sequence; it has 0-19");
  EXPECT_FALSE(exists("map.bt"));
}

TEST_F(CleanTest, WhatIsMissingIsOneLine) { fails("clean nowhere map.bt", 1, "nowhere: No such file"); }

}  // namespace
}  // namespace rhmap::test
