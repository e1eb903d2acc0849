// SPDX-License-Identifier: BSD-3-Clause
#include <octomap/OcTree.h>
#include <octomap/ScanGraph.h>

#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "program.hpp"

namespace rhmap::test {
namespace {

constexpr const char* kGraph = "data/maps/spherical_scan.graph";

struct BuildTest : ProgramTest {
  nlohmann::json summary(const std::string& arguments) const {
    return nlohmann::json::parse(runs("build " + arguments + " --json -"));
  }

  /// Three scans in KITTI's layout, each with 50 points near the sensor and 200 farther away.
  void writeKitti() const {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::filesystem::create_directories(folder / "kitti/velodyne");
    std::string poses;
    for (int scan = 0; scan < 3; ++scan) {
      std::string points;
      for (int i = 0; i < 250; ++i) {
        const float scale = i < 50 ? 1.F : 10.F;
        const float shift = i < 50 ? 0.F : 20.F;
        const float values[4] = {scale * unit(random) + shift, scale * unit(random), scale * unit(random), 0};
        points.append(reinterpret_cast<const char*>(values), sizeof(values));
      }
      writeFile(folder / ("kitti/velodyne/00000" + std::to_string(scan) + ".bin"), points);
      poses += "1 0 0 " + std::to_string(scan) + " 0 1 0 0 0 0 1 0\n";
    }
    writeFile(folder / "kitti/poses.txt", poses);
  }
};

/// What OctoMap makes of the scan graph.
octomap::OcTree octomapOfGraph(double resolution, double max_range) {
  octomap::ScanGraph graph;
  EXPECT_TRUE(graph.readBinary(dataFile("maps/spherical_scan.graph")));
  octomap::OcTree tree(resolution);
  for (const octomap::ScanNode* node : graph) {
    octomap::Pointcloud points(*node->scan);
    points.transform(node->pose);
    tree.insertPointCloud(points, node->pose.trans(), max_range);
  }
  return tree;
}

TEST_F(BuildTest, WritesTheFilesThatOctomapWrites) {
  for (const std::string mapper : {"rhmap", "octomap"}) {
    runs(std::string("build ") + kGraph + " map.bt map.ot --resolution 0.05 --max-range 9 --mapper " + mapper);
    octomap::OcTree expected = octomapOfGraph(0.05, 9);
    std::ostringstream full, most_likely;
    expected.write(full);
    expected.writeBinary(most_likely);
    EXPECT_TRUE(bytes("map.ot") == full.str()) << mapper;
    EXPECT_TRUE(bytes("map.bt") == most_likely.str()) << mapper;
  }
}

TEST_F(BuildTest, HasNoMaximumRangeByDefault) {
  runs(std::string("build ") + kGraph + " map.ot");
  octomap::OcTree expected = octomapOfGraph(0.1, -1);
  std::ostringstream full;
  expected.write(full);
  EXPECT_TRUE(bytes("map.ot") == full.str());
}

TEST_F(BuildTest, SummarisesForPrograms) {
  const auto json = summary(std::string(kGraph) + " map.bt map.ot --max-range 9");
  EXPECT_EQ(json["scans"], 1);
  EXPECT_EQ(json["points"], 10201);
  EXPECT_EQ(json["dropped_points"], 0);
  EXPECT_EQ(json["resolution_m"], 0.1);
  EXPECT_EQ(json["max_range_m"], 9);
  EXPECT_EQ(json["threads"], 1);
  ASSERT_EQ(json["maps"].size(), 1U);
  EXPECT_EQ(json["maps"][0]["mapper"], "rhmap");
  EXPECT_GT(json["maps"][0]["nodes"], 1000);
  EXPECT_GT(json["maps"][0]["median_scan_s"], 0);
  EXPECT_EQ(json["maps"][0]["scan_s"].size(), 1U);
  EXPECT_TRUE(json["maps"][0].contains("resident_memory_bytes"));
  EXPECT_FALSE(json.contains("compare"));
  ASSERT_EQ(json["files"].size(), 2U);
  EXPECT_EQ(json["files"][0]["path"], "map.bt");
  EXPECT_EQ(json["files"][1]["bytes"], bytes("map.ot").size());
}

TEST_F(BuildTest, SummarisesForPeople) {
  const std::string text = runs(std::string("build ") + kGraph + " map.bt --json summary.json");
  for (const std::string part : {"scans     1\n", "points    10,201, and 0 dropped\n", "nodes", "leaves",
                                 "time per scan, median", "resident memory", "written   map.bt ("})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(nlohmann::json::parse(bytes("summary.json"))["points"], 10201);
}

TEST_F(BuildTest, ComparesWithOctomapOnTheSameScans) {
  writeKitti();
  const auto json = summary("kitti map.bt --compare");
  ASSERT_EQ(json["maps"].size(), 2U);
  EXPECT_EQ(json["maps"][0]["mapper"], "rhmap");
  EXPECT_EQ(json["maps"][1]["mapper"], "octomap");
  EXPECT_EQ(json["maps"][0]["nodes"], json["maps"][1]["nodes"]);
  EXPECT_EQ(json["maps"][0]["leaves"], json["maps"][1]["leaves"]);
  EXPECT_EQ(json["maps"][1]["scan_s"].size(), 3U);
  EXPECT_EQ(json["compare"]["ot_identical"], true);
  EXPECT_EQ(json["compare"]["bt_identical"], true);
  EXPECT_GT(json["compare"]["speed_ratio"], 0);
  const std::string text = runs("build kitti map.bt --compare");
  EXPECT_NE(text.find("bytes     .ot identical, .bt identical\n"), std::string::npos) << text;
}

TEST_F(BuildTest, ResidentMemoryIsNotBelowWhatTheTreesHold) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers bring an allocator of their own";
#endif
  const auto json = summary(std::string(kGraph) + " map.bt --resolution 0.02 --compare");
  for (const auto& map : json["maps"]) {
    if (map["resident_memory_bytes"].is_null()) GTEST_SKIP() << "no /proc/self/statm";
    EXPECT_GT(map["resident_memory_bytes"].get<double>(), 0.9 * map["memory_usage_bytes"].get<double>()) << map;
  }
}

TEST_F(BuildTest, TakesBothEndsOfTheFrames) {
  writeKitti();
  EXPECT_EQ(summary("kitti map.bt")["scans"], 3);
  const auto json = summary("kitti map.bt --frames 1-2");
  EXPECT_EQ(json["scans"], 2);
  EXPECT_EQ(json["first_scan"], 1);
  EXPECT_EQ(json["last_scan"], 2);
  EXPECT_EQ(summary("kitti map.bt --frames 2")["scans"], 1);
}

TEST_F(BuildTest, DropsAndCountsPointsNearerThanTheMinimumRange) {
  writeKitti();
  const auto json = summary("kitti map.bt --min-range 2.7");
  EXPECT_EQ(json["dropped_points"], 150);
  EXPECT_EQ(json["points"], 600);
}

TEST_F(BuildTest, WritesTheSameBytesForAnyNumberOfThreads) {
  writeKitti();
  runs("build kitti one.ot --threads 1");
  runs("build kitti three.ot --threads 3");
  EXPECT_TRUE(bytes("one.ot") == bytes("three.ot"));
}

TEST_F(BuildTest, DrawsAProgressBarOnATerminalOnly) {
  writeKitti();
  runs("build kitti map.bt");  // and nothing on stderr
  const Outcome outcome = shell("script -qec \"'" RHMAP_PROGRAM "' build kitti map.bt\" /dev/null");
  if (outcome.exit_code == 127) GTEST_SKIP() << "no script(1), which makes a terminal";
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("] 3/3"), std::string::npos) << outcome.out;
}

TEST_F(BuildTest, AMissingSequenceIsOneLine) { fails("build nowhere map.bt", 1, "nowhere: No such file"); }

TEST_F(BuildTest, AnUnreadableSequenceIsOneLineAndNoMap) {
  writeFile(folder / "broken.graph", "no graph");
  const Outcome outcome = rhmap("build broken.graph map.bt");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("broken.graph"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  EXPECT_FALSE(exists("map.bt"));
}

TEST_F(BuildTest, LeavesNothingBehindButItsFiles) {
  runs(std::string("build ") + kGraph + " map.bt");
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++entries;
  EXPECT_EQ(entries, 2U);  // data and map.bt
}

}  // namespace
}  // namespace rhmap::test
