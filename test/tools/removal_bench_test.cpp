// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace rhmap::test {
namespace {

struct RemovalBenchTest : ProgramTest {
  RemovalBenchTest() { runs("simulate street street --beams 16 --frames 6"); }

  Outcome bench(const std::string& arguments) const { return shell("'" RHMAP_REMOVAL_BENCH "' " + arguments); }
};

TEST_F(RemovalBenchTest, MeasuresEachStageOfEachProfileAndWindowsOfScans) {
  const Outcome outcome = bench("street --resolution 0.2 --rounds 2 --window 4 --json bench.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("street, 6 scans, 0.2 m, rounds: 2\n\n| ms a scan | fast | default |\n"),
            std::string::npos)
      << outcome.out;

  const nlohmann::json sequence = nlohmann::json::parse(bytes("bench.json")).at("sequences").at(0);
  ASSERT_EQ(sequence.at("profiles").size(), 2U);
  for (const nlohmann::json& profile : sequence.at("profiles")) {
    for (const std::string stage : {"transform", "regions", "ground", "image", "removal", "map"})
      EXPECT_GT(profile.at("median_stage_s").at(stage), 0.) << stage;
    EXPECT_EQ(profile.at("scan_s").size(), 6U);
    EXPECT_GT(profile.at("median_scan_s"), 0.);
    EXPECT_GE(profile.at("percentile_95_scan_s"), profile.at("median_scan_s"));
    EXPECT_GT(profile.at("finish_s"), 0.);

    const nlohmann::json& windows = profile.at("windows");
    ASSERT_EQ(windows.size(), 2U);
    EXPECT_EQ(windows[0].at("last_scan"), 3);
    EXPECT_EQ(windows[1].at("first_scan"), 4);
    EXPECT_EQ(windows[1].at("last_scan"), 5);
    EXPECT_NEAR(windows[1].at("way_m"), 4, 0.1);  // five steps at 8 m/s
    for (const std::string memory : {"removal_bytes", "tree_bytes", "process_bytes"})
      EXPECT_GT(windows[1].at(memory), 0.) << memory;
  }
}

TEST_F(RemovalBenchTest, SaysInOneLineWhatIsWrong) {
  const Outcome missing = bench("nowhere");
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_EQ(missing.err.substr(0, 29), "rhmap_removal_bench: nowhere:");
  EXPECT_EQ(bench("street --profile slow").exit_code, 2);
  EXPECT_EQ(bench("street --window 0").exit_code, 2);
}

}  // namespace
}  // namespace rhmap::test
