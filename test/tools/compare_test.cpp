// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace rhmap::test {
namespace {

using testing::HasSubstr;

struct CompareTest : ProgramTest {
  nlohmann::json comparison(const std::string& arguments) const {
    return nlohmann::json::parse(runs("compare " + arguments + " --json -"));
  }
};

TEST_F(CompareTest, BothWriteTheSameBytes) {
  const auto json = comparison("data/maps/spherical_scan.graph --min-range 0 --resolution 0.05");
  EXPECT_EQ(json["ot_identical"], true);
  EXPECT_EQ(json["bt_identical"], true);
  EXPECT_TRUE(json["difference"].is_null());
  ASSERT_EQ(json["mappers"].size(), 2U);
  EXPECT_EQ(json["mappers"][0]["mapper"], "rhmap");
  EXPECT_EQ(json["mappers"][1]["mapper"], "octomap");
  EXPECT_EQ(json["mappers"][0]["nodes"], json["mappers"][1]["nodes"]);
  EXPECT_EQ(json["points"], 10201);
  EXPECT_EQ(json["scores"].size(), 0U);
}

TEST_F(CompareTest, GivesTimeAndMemoryOfEachScan) {
  runs("simulate street street --beams 16 --frames 3");
  const auto json = comparison("street --resolution 0.4");
  for (const auto& mapper : json["mappers"]) {
    ASSERT_EQ(mapper["scan_s"].size(), 3U);
    ASSERT_EQ(mapper["scan_memory_bytes"].size(), 3U);
    EXPECT_LE(mapper["scan_memory_bytes"][0], mapper["scan_memory_bytes"][2]);
    EXPECT_EQ(mapper["scan_memory_bytes"][2], mapper["memory_usage_bytes"]);
  }
  const std::string csv = runs("compare street --resolution 0.4 --csv -");
  EXPECT_THAT(csv, testing::StartsWith("scan,mapper,seconds,memory_bytes\n0,rhmap,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 2);
}

TEST_F(CompareTest, SaysWhatEachKeepsOfTheMovingAndOfTheStatic) {
  runs("simulate street street --beams 32 --frames 12 --rate 2");
  const std::string text = runs("compare street --resolution 0.2 --max-range 40 --profile default --json all.json");
  for (const std::string row :
       {"\nno removal ", "\noracle ", "\noctomap ", "\noctomap, ground kept ", "\nrhmap default "})
    EXPECT_THAT(text, HasSubstr(row));
  const auto json = nlohmann::json::parse(bytes("all.json"));
  ASSERT_EQ(json["mappers"].size(), 3U);
  EXPECT_EQ(json["mappers"][2]["mapper"], "rhmap default");
  EXPECT_EQ(json["mappers"][2]["scan_s"].size(), 12U);
  const auto cells = [&](const std::string& name) {
    for (const auto& score : json["scores"])
      if (score["row"] == name) return score["cells"];
    return nlohmann::json();
  };
  // Rays erase what moved, and static cells with it; a ground that they cannot touch is kept.
  EXPECT_LT(cells("octomap")["dynamic_kept"], cells("no removal")["dynamic_kept"]);
  EXPECT_LT(cells("octomap")["static_kept"], cells("octomap, ground kept")["static_kept"]);
  EXPECT_LE(cells("octomap, ground kept")["static_kept"], cells("no removal")["static_kept"]);
  EXPECT_GT(cells("rhmap default")["static_kept"], cells("octomap")["static_kept"]);
}

TEST_F(CompareTest, IsARowOfTheEvaluation) {
  runs("simulate street street --beams 16 --frames 3");
  const std::string text = runs("evaluate street --resolution 0.2 --protocol rhmap --octomap");
  EXPECT_THAT(text, HasSubstr("\noctomap "));
  EXPECT_THAT(text, HasSubstr("\noctomap, ground kept "));
}

TEST_F(CompareTest, SaysWhatIsWrong) {
  fails("compare nowhere", 1, "nowhere: No such file");
  EXPECT_EQ(rhmap("compare data/maps/spherical_scan.graph --profile best").exit_code, 2);
}

}  // namespace
}  // namespace rhmap::test
