// SPDX-License-Identifier: BSD-3-Clause
// rhmap evaluate --tables on folders that are laid out as SemanticKITTI is.
#include <cstdint>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace rhmap::test {
namespace {

struct PaperTablesTest : ProgramTest {
  PaperTablesTest() { std::filesystem::create_directories(folder / "kitti/sequences"); }

  /// Two simulated sequences, one below sequences/ and one beside it, and windows for them.
  void simulate() const {
    runs("simulate street kitti/sequences/00 --beams 16 --frames 6 --rate 5");
    runs("simulate crowd kitti/01 --beams 16 --frames 5");
  }

  /// The paper's clip of sequence 02, of next to nothing: a wall and somebody who walks along it.
  void writeClipOf02() const {
    const std::filesystem::path sequence = folder / "kitti/sequences/02";
    std::filesystem::create_directories(sequence / "velodyne");
    std::filesystem::create_directories(sequence / "labels");
    std::string poses;
    for (int scan = 0; scan <= 950; ++scan) {
      poses += "1 0 0 0 0 1 0 0 0 0 1 0\n";
      if (scan < 860) continue;
      std::string points, labels;
      for (int k = 0; k < 5; ++k) {
        const float values[4] = {k == 4 ? 8.05F : 10.05F, 0.05F + 0.5F * static_cast<float>(k == 4 ? scan - 860 : k), 0,
                                 0};
        const std::uint32_t label = k == 4 ? 254 : 50;
        points.append(reinterpret_cast<const char*>(values), sizeof(values));
        labels.append(reinterpret_cast<const char*>(&label), sizeof(label));
      }
      const std::string name = "000" + std::to_string(scan);
      writeFile(sequence / "velodyne" / (name + ".bin"), points);
      writeFile(sequence / "labels" / (name + ".label"), labels);
    }
    writeFile(sequence / "poses.txt", poses);
  }
};

TEST_F(PaperTablesTest, AreOfFrontEndOnlyAndBothForEveryProfile) {
  simulate();
  const std::string text = runs("evaluate kitti --tables --windows 00:1-5,01:0-4 --json tables.json");
  for (const std::string part : {"sequence  00, scans 1-5\n", "sequence  01, scans 0-4\n", "\nTable I: ",
                                 "\nTable II: ", "\n00    no removal                   100.00     0.00   0.0000\n",
                                 "\n01    oracle                       100.00   100.00   1.0000\n",
                                 "\n00    paper, front end only ", "\n01    default "})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(text.find("missing"), std::string::npos);
  EXPECT_EQ(text.find("published"), std::string::npos);  // for other windows than the paper's
  const auto json = nlohmann::json::parse(bytes("tables.json"));
  ASSERT_EQ(json["sequences"].size(), 2U);
  const auto& first = json["sequences"][0];
  EXPECT_EQ(first["sequence"], "00");
  EXPECT_EQ(first["rows"].size(), 8U);
  EXPECT_EQ(first["runs"].size(), 6U);
  EXPECT_EQ(first["runs"][0]["row"], "paper, front end only");
  EXPECT_EQ(first["runs"][0]["keyframes"], 0);
  EXPECT_GT(first["runs"][1]["keyframes"], 0);
  EXPECT_EQ(first["runs"][1]["scans"], 5);
  EXPECT_TRUE(first["published"].is_null());
}

TEST_F(PaperTablesTest, TheirRowsAreThoseOfEvaluate) {
  simulate();
  const auto table = nlohmann::json::parse(
      runs("evaluate kitti --tables --windows 00:1-5 --profile fast --protocol rhmap,erasor --json -"));
  const auto alone = nlohmann::json::parse(
      runs("evaluate kitti/sequences/00 --frames 1-5 --profile fast --protocol rhmap,erasor --json -"));
  const auto& rows = table["sequences"][0]["rows"];
  ASSERT_EQ(rows.size(), 2 * 4U);
  EXPECT_EQ(rows[3], alone["rows"][2]);
  EXPECT_EQ(rows[7], alone["rows"][5]);
}

TEST_F(PaperTablesTest, WhatIsMissingIsNamedAndTheRestHasThePublishedFiguresBeside) {
  writeClipOf02();
  runs("simulate street kitti/sequences/05 --beams 16 --frames 2");
  std::filesystem::create_directories(folder / "kitti/sequences/07/labels");
  const std::string text = runs("evaluate kitti --tables --profile fast --json tables.json");
  for (const std::string part :
       {"missing   00 no such folder; 01 no such folder; 05 has scans 000000 to 000001, not all of 2350-2670; 07 "
        "cannot "
        "be read: kitti/sequences/07/velodyne: no such folder; KITTI's scans are expected in velodyne/*.bin\n",
        "sequence  02, scans 860-950\n", "  98.86    77.28   0.8670\n", "  90.44    91.27   0.9085\n",
        "  66.98     14.9\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  const auto json = nlohmann::json::parse(bytes("tables.json"));
  EXPECT_EQ(json["sequences"].size(), 1U);
  EXPECT_EQ(json["sequences"][0]["runs"][0]["scans"], 91);
  EXPECT_EQ(json["sequences"][0]["published"]["both"]["F1"], 0.908511);
  EXPECT_EQ(json["missing"].size(), 4U);
  EXPECT_EQ(json["missing"][2]["sequence"], "05");
}

TEST_F(PaperTablesTest, WithoutAnySequenceThereIsOneLine) {
  fails("evaluate kitti --tables --windows 00:0-5", 1,
        "kitti: nothing to evaluate: 00 no such folder; SemanticKITTI is expected, sequences/NN or NN with velodyne, "
        "labels, poses.txt and calib.txt");
  fails("evaluate nowhere --tables", 1, "nowhere: No such file");
}

TEST_F(PaperTablesTest, WrongWordsAreAnsweredWithTheRightOnes) {
  const std::string help = "; see rhmap evaluate --help";
  fails("evaluate kitti --tables --windows 00:5-1", 2,
        "--windows: 00:5-1 is not a window; SEQUENCE:A-B with A not above B, e.g. 05:2350-2670" + help);
  fails("evaluate kitti --windows 00:0-5", 2, "--windows requires --tables" + help);
  fails("evaluate kitti --tables --frames 0-5", 2, "--frames excludes --tables" + help);
  fails("evaluate kitti --tables --protocol kth", 2,
        "--tables are of PR and RR, which protocol kth has not; one of: rhmap, erasor");
}

}  // namespace
}  // namespace rhmap::test
