// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "program.hpp"

namespace rhmap::test {
namespace {

struct EvaluateTest : ProgramTest {
  EvaluateTest() {
    std::filesystem::create_directories(folder / "street/velodyne");
    std::filesystem::create_directories(folder / "street/labels");
    std::string poses;
    for (int scan = 0; scan < 3; ++scan) {
      std::string points, labels;
      for (int k = 0; k < 10; ++k) {
        // A wall at 10 m, and somebody who walks along it, a metre a scan.
        const bool walker = k == 9;
        const float values[4] = {walker ? 8.05F : 10.05F, 0.55F + static_cast<float>(walker ? scan : k), 0.05F, 0};
        const std::uint32_t label = walker ? 254U | 3U << 16 : k == 8 ? 0 : 50;
        points.append(reinterpret_cast<const char*>(values), sizeof(values));
        labels.append(reinterpret_cast<const char*>(&label), sizeof(label));
      }
      writeFile(folder / ("street/velodyne/00000" + std::to_string(scan) + ".bin"), points);
      writeFile(folder / ("street/labels/00000" + std::to_string(scan) + ".label"), labels);
      poses += "1 0 0 0 0 1 0 0 0 0 1 0\n";
    }
    writeFile(folder / "street/poses.txt", poses);
  }

  nlohmann::json rows(const std::string& arguments) const {
    return nlohmann::json::parse(runs("evaluate street " + arguments + " --json -"))["rows"];
  }
};

TEST_F(EvaluateTest, GivesTheBaselinesUnderAllProtocols) {
  const auto json = nlohmann::json::parse(runs("evaluate street --json -"));
  EXPECT_EQ(json["first_scan"], 0);
  EXPECT_EQ(json["last_scan"], 2);
  EXPECT_TRUE(json["max_range_m"].is_null());
  const auto& rows = json["rows"];
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[0]["protocol"], "rhmap");
  EXPECT_EQ(rows[0]["row"], "no removal");
  EXPECT_EQ(rows[0]["cells"]["static"], 8);
  EXPECT_EQ(rows[0]["cells"]["dynamic"], 3);
  EXPECT_EQ(rows[0]["cells"]["PR"], 1.0);
  EXPECT_EQ(rows[0]["cells"]["RR"], 0.0);
  EXPECT_EQ(rows[0]["cells"]["F1"], 0.0);
  EXPECT_EQ(rows[0]["cells"]["estimate_dynamic"], 3);
  EXPECT_EQ(rows[1]["row"], "oracle");
  EXPECT_EQ(rows[1]["cells"]["RR"], 1.0);
  EXPECT_EQ(rows[1]["cells"]["classes"][0]["class"], 254);
  EXPECT_EQ(rows[1]["cells"]["classes"][0]["dynamic"], 3);
  EXPECT_EQ(rows[3]["cells"]["F1"], 1.0);
  EXPECT_EQ(rows[4]["points"]["static"], 24);
  EXPECT_EQ(rows[5]["points"]["AA"], 1.0);
  EXPECT_EQ(rows[5]["points"]["HA"], 1.0);
}

TEST_F(EvaluateTest, ScoresAMapOfRhmap) {
  runs("build street map.bt");  // the walker's earlier places are not looked through
  for (const auto& row : rows("--map map.bt")) {
    if (row["row"] != "map.bt") continue;
    const auto& part = row.contains("cells") ? row["cells"] : row["points"];
    EXPECT_EQ(part[row.contains("cells") ? "PR" : "SA"], 1.0) << row;
    EXPECT_EQ(part[row.contains("cells") ? "RR" : "DA"], 0.0) << row;
  }
}

TEST_F(EvaluateTest, ScoresACloudMadeElsewhere) {
  // The wall but its first metre, and the last of the walker's places.
  std::string lines = "8.05 2.55 0.05\n";
  for (int k = 1; k < 8; ++k) lines += "10.05 " + std::to_string(k) + ".55 0.05\n";
  writeFile(folder / "clean.xyz", lines);
  const auto all = rows("--map clean.xyz");
  ASSERT_EQ(all.size(), 9U);
  EXPECT_EQ(all[2]["row"], "clean.xyz");
  EXPECT_EQ(all[2]["cells"]["PR"], 7 / 8.0);
  EXPECT_NEAR(all[2]["cells"]["RR"].get<double>(), 2 / 3.0, 1e-12);
  EXPECT_EQ(all[5]["cells"]["static_kept"], 7);
  EXPECT_EQ(all[8]["points"]["static_kept"], 21);
  EXPECT_EQ(all[8]["points"]["dynamic_kept"], 1);
}

TEST_F(EvaluateTest, PrintsATableAProtocol) {
  const std::string text = runs("evaluate street --frames 0-1 --protocol rhmap,kth --json scores.json");
  for (const std::string part :
       {"sequence  street, scans 0-1\n", "\nprotocol rhmap\n", "\nprotocol kth\n", "PR", "SA", "RR 254",
        "no removal      100.00    0.00  0.0000", "oracle          100.00  100.00  100.00  100.00", "16 / 16"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(text.find("erasor"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(bytes("scores.json"))["rows"].size(), 4U);
}

TEST_F(EvaluateTest, WithoutMoversRatesAreNullAndADash) {
  const auto json = rows("--max-range 9 --protocol rhmap");  // the walker only
  EXPECT_TRUE(json[0]["cells"]["PR"].is_null());
  EXPECT_TRUE(json[0]["cells"]["F1"].is_null());
  EXPECT_EQ(json[0]["cells"]["RR"], 0.0);
  EXPECT_NE(
      runs("evaluate street --min-range 9.5 --protocol kth").find("no removal      100.00       -       -       -"),
      std::string::npos);
}

TEST_F(EvaluateTest, TheResolutionIsThatOfTheCubes) {
  EXPECT_EQ(rows("--resolution 2 --protocol rhmap")[0]["cells"]["static"], 4);
}

TEST_F(EvaluateTest, WhatIsMissingIsOneLine) {
  fails("evaluate nowhere", 1, "nowhere: No such file");
  fails("evaluate street --map nowhere.pcd", 1, "nowhere.pcd: No such file");
  fails("evaluate data/maps/spherical_scan.graph", 1,
        "data/maps/spherical_scan.graph: has no labels (labels/NNNNNN.label) to score against");
  writeFile(folder / "broken.ply", "ply\n");
  fails("evaluate street --map broken.ply", 1, "broken.ply: has no header that ends");
}

TEST_F(EvaluateTest, WrongWordsAreAnsweredWithTheRightOnes) {
  const std::string help = "; see rhmap evaluate --help";
  fails("evaluate street --protocol rhmap,otd", 2,
        "--protocol: otd is not a protocol; one of: rhmap, erasor, kth" + help);
  fails("evaluate street --map map.las", 2,
        "--map: map.las has no known extension; one of: .bt, .ot, .pcd, .ply, .xyz, .txt, .dat" + help);
  fails("evaluate street --frames 0-3", 2, "--frames: 0-3 is not in the sequence; it has 0-2");
}

}  // namespace
}  // namespace rhmap::test
