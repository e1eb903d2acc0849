// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
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

  nlohmann::json summary(const std::string& arguments) const {
    return nlohmann::json::parse(runs("evaluate " + arguments + " --json -"));
  }

  nlohmann::json rows(const std::string& arguments) const { return summary("street " + arguments)["rows"]; }

  /// The row of that name, cells or points.
  static nlohmann::json part(const nlohmann::json& rows, const std::string& protocol, const std::string& name,
                             const char* what) {
    for (const auto& row : rows) {
      if (row["protocol"] == protocol && row["row"] == name) return row[what];
    }
    ADD_FAILURE() << "no row " << name << " of protocol " << protocol;
    return {};
  }
};

TEST_F(EvaluateTest, GivesTheBaselinesUnderAllProtocols) {
  const auto json = summary("street");
  EXPECT_EQ(json["first_scan"], 0);
  EXPECT_EQ(json["last_scan"], 2);
  EXPECT_EQ(json["min_range_m"], 2.7);
  EXPECT_TRUE(json["max_range_m"].is_null());
  const auto& rows = json["rows"];
  ASSERT_EQ(rows.size(), 3 * 3 + 2U);
  const auto nothing = part(rows, "rhmap", "no removal", "cells");
  EXPECT_EQ(nothing["static"], 8);
  EXPECT_EQ(nothing["dynamic"], 3);
  EXPECT_EQ(nothing["PR"], 1.0);
  EXPECT_EQ(nothing["RR"], 0.0);
  EXPECT_EQ(nothing["F1"], 0.0);
  EXPECT_EQ(nothing["estimate_dynamic"], 3);
  const auto oracle = part(rows, "rhmap", "oracle", "cells");
  EXPECT_EQ(oracle["RR"], 1.0);
  EXPECT_EQ(oracle["classes"][0]["class"], 254);
  EXPECT_EQ(oracle["classes"][0]["dynamic"], 3);
  EXPECT_EQ(oracle["groups"][0]["classes"], "251");
  EXPECT_TRUE(oracle["groups"][0]["RR"].is_null());
  EXPECT_EQ(oracle["groups"][1]["classes"], "252-259");
  EXPECT_EQ(oracle["groups"][1]["RR"], 1.0);
  EXPECT_EQ(part(rows, "erasor", "oracle", "cells")["F1"], 1.0);
  EXPECT_EQ(part(rows, "kth", "no removal", "points")["static"], 24);
  EXPECT_EQ(part(rows, "kth", "oracle", "points")["AA"], 1.0);
  EXPECT_EQ(part(rows, "kth", "oracle", "points")["HA"], 1.0);
}

TEST_F(EvaluateTest, ScoresAMapOfRhmap) {
  runs("build street map.bt");  // the walker's earlier places are not looked through
  for (const auto& row : rows("--map map.bt")) {
    if (row["row"] != "map.bt") continue;
    const auto& scores = row.contains("cells") ? row["cells"] : row["points"];
    EXPECT_EQ(scores[row.contains("cells") ? "PR" : "SA"], 1.0) << row;
    EXPECT_EQ(scores[row.contains("cells") ? "RR" : "DA"], 0.0) << row;
  }
}

TEST_F(EvaluateTest, RunsTheMapperAsCleanDoes) {
  runs("simulate street sim --beams 16 --frames 20");
  const std::string options = " --frames 2-19 --region-size 16 --max-range 60 --min-range 5";
  runs("clean sim clean.ply --profile fast" + options);
  const auto json = summary("sim --protocol rhmap --profile fast,default --map clean.ply" + options);
  const auto& rows = json["rows"];
  ASSERT_EQ(rows.size(), 5 + 4U);
  EXPECT_EQ(rows[2]["row"], "fast");
  EXPECT_EQ(rows[3]["row"], "default");
  EXPECT_EQ(rows[4]["row"], "clean.ply");
  // A cloud has no labels, but cubes of their own do as well where none is mixed after the removal.
  EXPECT_EQ(rows[2]["points"], rows[4]["points"]);
  for (const std::string profile : {"fast", "default"}) {
    EXPECT_GT(part(rows, "rhmap", profile, "cells")["PR"], 0.97) << profile;
    EXPECT_GT(part(rows, "rhmap", profile, "cells")["RR"], 0.5) << profile;
  }
  EXPECT_EQ(json["region_size"], 16);
  ASSERT_EQ(json["runs"].size(), 2U);
  EXPECT_EQ(json["runs"][0]["row"], "fast");
  EXPECT_EQ(json["runs"][1]["scans"], 18);
  EXPECT_GT(json["runs"][1]["median_scan_s"], 0);
  EXPECT_TRUE(json["runs"][1]["median_stage_s"].contains("ground"));
}

TEST_F(EvaluateTest, JudgesEachScanAtInsertionAndTenScansLater) {
  runs("simulate street sim --beams 16 --frames 15");
  const auto rows = summary("sim --protocol rhmap --profile fast")["rows"];
  const auto now = part(rows, "online", "fast, at insertion", "points");
  const auto later = part(rows, "online", "fast, 10 scans later", "points");
  const auto all = part(rows, "rhmap", "no removal", "points");
  EXPECT_EQ(now["static"], all["static"]);
  EXPECT_EQ(now["dynamic"], all["dynamic"]);
  EXPECT_LT(later["static"], all["static"]);  // of the first five scans only
  EXPECT_GT(now["SA"], 0.98);
  EXPECT_GT(later["DA"], now["DA"]);
}

TEST_F(EvaluateTest, AblationIsATableOfTheProfilesWithOnePartChanged) {
  runs("simulate street sim --beams 16 --frames 8 --rate 5");
  const auto json = summary("sim --ablation");
  std::set<std::string> names;
  for (const auto& run : json["runs"]) names.insert(run["row"]);
  EXPECT_EQ(names.size(), json["runs"].size());
  for (const std::string name : {"paper", "paper, front end only", "paper, regions of 4", "paper, regions of 16",
                                 "paper, 2D only", "paper + protect + hshrink", "paper + visibility", "fast", "default",
                                 "default, front end only", "default, R-GPE off", "default - void"}) {
    EXPECT_TRUE(names.contains(name)) << name;
    EXPECT_TRUE(part(json["rows"], "rhmap", name, "cells")["PR"].is_number()) << name;
  }
  const auto scores = [&](const std::string& name) { return part(json["rows"], "rhmap", name, "cells"); };
  EXPECT_NE(scores("paper, regions of 4"), scores("paper, regions of 16"));
  EXPECT_NE(scores("paper, R-GPE off"), scores("paper"));
  EXPECT_GT(scores("paper + visibility")["PR"], scores("paper")["PR"]);
  EXPECT_GT(scores("default")["RR"], scores("default - void")["RR"]);
  fails("evaluate sim --ablation --profile fast", 2, "--profile excludes --ablation; see rhmap evaluate --help");
}

/// What the mapper leaves out as the carrier's own is not asked for in its map.
TEST_F(EvaluateTest, NearPointsAreNobodysLoss) {
  runs("simulate static sim --beams 16 --frames 5");
  const auto rows = summary("sim --protocol rhmap,kth --min-range 12")["rows"];
  EXPECT_GT(part(rows, "rhmap", "default", "cells")["PR"], 0.99);
  EXPECT_GT(part(rows, "kth", "default", "points")["SA"], 0.99);
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
        "no removal      100.00    0.00  0.0000", "oracle          100.00  100.00  100.00  100.00", "16 / 16",
        "settings  resolution 0.1 m, regions of 8 cubes", "\nprotocol online\n", "default, at insertion ",
        "processor time of a scan [ms]"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(text.find("erasor"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(bytes("scores.json"))["rows"].size(), 2 * 3 + 2U);
}

TEST_F(EvaluateTest, Class251StandsApart) {
  for (const auto& [scan, label] : {std::pair(0, 251U), std::pair(1, 252U)}) {
    const std::string file = "street/labels/00000" + std::to_string(scan) + ".label";
    std::string labels = bytes(file);
    std::memcpy(labels.data() + labels.size() - sizeof(label), &label, sizeof(label));
    writeFile(folder / file, labels);
  }
  const std::string text = runs("evaluate street --protocol rhmap --json scores.json");
  EXPECT_NE(text.find("  RR 252-254  RR 251  RR 252  RR 254\n"), std::string::npos) << text;
  const auto groups =
      part(nlohmann::json::parse(bytes("scores.json"))["rows"], "rhmap", "no removal", "cells")["groups"];
  EXPECT_EQ(groups[0]["dynamic"], 1);
  EXPECT_EQ(groups[1]["dynamic"], 2);
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

TEST_F(EvaluateTest, ListsEndBeforeTheSequence) {
  const auto json = summary("--protocol rhmap,kth --profile fast,default street");
  EXPECT_EQ(json["rows"].size(), 2 * 4 + 4U);
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
  fails("evaluate street --profile fast,best", 2,
        "--profile: best is not a profile; one of: paper, fast, default" + help);
  runs("build street map.bt");
  fails("evaluate street --map map.bt --region-size 4", 2,
        "--region-size is for a run of the mapper, which --map alone leaves out; add --profile, any of: paper, fast, "
        "default");
  fails("evaluate street --frames 0-3", 2, "--frames: 0-3 is not in the sequence; it has 0-2");
}

}  // namespace
}  // namespace rhmap::test
