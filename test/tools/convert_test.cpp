// SPDX-License-Identifier: BSD-3-Clause
#include <octomap/OcTree.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <vector>

#include "program.hpp"

namespace rhmap::test {
namespace {

struct ConvertTest : ProgramTest {
  /// What OctoMap writes for `tree` with one of its functions.
  static std::string written(octomap::OcTree& tree, bool (octomap::AbstractOccupancyOcTree::*write)(std::ostream&)) {
    std::ostringstream out;
    (tree.*write)(out);
    return out.str();
  }

  std::unique_ptr<octomap::OcTree> readOt(const std::string& name) const {
    return std::unique_ptr<octomap::OcTree>(
        dynamic_cast<octomap::OcTree*>(octomap::AbstractOcTree::read((folder / name).string())));
  }
};

TEST_F(ConvertTest, ReproducesBtFilesByteForByte) {
  for (const std::string map : {"maps/geb079.bt", "maps/rotors_power_plant_sim.bt", "golden/empty.bt",
                                "golden/one_hit.bt", "golden/one_color.bt", "golden/hit_and_miss.bt",
                                "golden/pruned_cube.bt", "golden/varied_cube_const.bt", "golden/varied_cube_ml.bt"}) {
    runs("convert data/" + map + " out.bt");
    EXPECT_TRUE(bytes("out.bt") == readFile(dataFile(map))) << map;
  }
}

TEST_F(ConvertTest, ReproducesOtFilesByteForByte) {
  for (const std::string map : {"empty.ot", "one_hit.ot", "hit_and_miss.ot", "pruned_cube.ot", "varied_cube.ot",
                                "one_color.ot", "one_stamped.ot"}) {
    runs("convert data/golden/" + map + " out.ot");
    EXPECT_TRUE(bytes("out.ot") == readFile(dataFile("golden/" + map))) << map;
  }
}

TEST_F(ConvertTest, TakesColourMapsToBtAndToClouds) {
  runs("convert data/golden/one_color.ot out.bt");
  EXPECT_TRUE(bytes("out.bt") == readFile(dataFile("golden/one_color.bt")));
  runs("convert data/golden/one_color.ot out.ply");
  EXPECT_NE(bytes("out.ply").find("element vertex 1\n"), std::string::npos);
}

TEST_F(ConvertTest, OtToBtIsOctomapsWriteBinary) {
  for (const std::string map : {"hit_and_miss.ot", "pruned_cube.ot", "varied_cube.ot"}) {
    runs("convert data/golden/" + map + " out.bt");
    const auto tree = readOt("data/golden/" + map);
    EXPECT_TRUE(bytes("out.bt") == written(*tree, &octomap::AbstractOccupancyOcTree::writeBinary)) << map;
  }
}

TEST_F(ConvertTest, BtToOtHasTheClampingThresholds) {
  runs("convert data/maps/rotors_power_plant_sim.bt out.ot");
  octomap::OcTree expected(dataFile("maps/rotors_power_plant_sim.bt"));
  std::ostringstream out;
  expected.write(out);
  EXPECT_TRUE(bytes("out.ot") == out.str());
}

TEST_F(ConvertTest, BtToOtAndBackIsTheSameBt) {
  runs("convert data/maps/rotors_power_plant_sim.bt there.ot");
  runs("convert there.ot back.bt");
  EXPECT_TRUE(bytes("back.bt") == readFile(dataFile("maps/rotors_power_plant_sim.bt")));
}

/// The floats behind the header of a cloud file, three a point.
std::vector<float> cloud(const std::string& bytes, const std::string& header_end) {
  const std::string body = bytes.substr(bytes.find(header_end) + header_end.size());
  std::vector<float> values(body.size() / sizeof(float));
  std::copy_n(body.data(), values.size() * sizeof(float), reinterpret_cast<char*>(values.data()));
  return values;
}

TEST_F(ConvertTest, CloudsHoldTheLeavesOfTheExpandedMapInTheOrderOfTheTree) {
  octomap::OcTree tree(dataFile("maps/rotors_power_plant_sim.bt"));
  tree.expand();
  std::vector<float> expected;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const octomap::point3d centre = leaf.getCoordinate();
    expected.insert(expected.end(), {centre.x(), centre.y(), centre.z()});
  }
  runs("convert data/maps/rotors_power_plant_sim.bt cells.ply");
  runs("convert data/maps/rotors_power_plant_sim.bt cells.pcd");
  EXPECT_TRUE(cloud(bytes("cells.ply"), "end_header\n") == expected);
  EXPECT_TRUE(cloud(bytes("cells.pcd"), "DATA binary\n") == expected);
}

TEST_F(ConvertTest, ExtensionsMayBeInCapitals) {
  runs("convert data/golden/one_hit.bt OUT.OT");
  EXPECT_TRUE(bytes("OUT.OT").starts_with("# Octomap OcTree file"));
}

TEST_F(ConvertTest, AFileMayReplaceItself) {
  std::filesystem::copy_file(dataFile("golden/one_hit.bt"), folder / "map.bt");
  runs("convert map.bt map.bt");
  EXPECT_TRUE(bytes("map.bt") == readFile(dataFile("golden/one_hit.bt")));
}

TEST_F(ConvertTest, EveryTruncatedFileIsRefusedAndNothingIsWritten) {
  for (const std::string map : {"hit_and_miss.bt", "hit_and_miss.ot"}) {
    const std::string whole = readFile(dataFile("golden/" + map));
    for (std::size_t size = whole.find("data\n"); size < whole.size(); size += 3) {
      writeFile(folder / map, whole.substr(0, size));
      const Outcome outcome = rhmap("convert " + map + " out.ot");
      EXPECT_EQ(outcome.exit_code, 1) << map << " " << size;
      EXPECT_TRUE(outcome.err.starts_with("rhmap: " + map + ": ")) << outcome.err;
      EXPECT_FALSE(exists("out.ot"));
    }
  }
}

TEST_F(ConvertTest, AWrongNodeCountIsRefused) {
  std::string map = readFile(dataFile("golden/hit_and_miss.bt"));
  map.replace(map.find("size "), 5, "size 9");
  writeFile(folder / "count.bt", map);
  EXPECT_EQ(rhmap("convert count.bt out.bt").exit_code, 1);
  EXPECT_FALSE(exists("out.bt"));
}

TEST_F(ConvertTest, NodesBelowTheFinestLevelAreRefused) {
  std::string map = "# Octomap OcTree binary file\nid OcTree\nsize 18\nres 0.1\ndata\n";
  for (int depth = 0; depth < 17; ++depth) map += std::string("\x03\0", 2);
  writeFile(folder / "deep.bt", map);
  EXPECT_EQ(rhmap("convert deep.bt out.bt").exit_code, 1);
  EXPECT_FALSE(exists("out.bt"));
}

TEST_F(ConvertTest, MoreCellsThanACloudCanHoldAreRefused) {
  writeFile(folder / "all.bt",
            "# Octomap OcTree binary file\nid OcTree\nsize 1\nres 0.1\ndata\n" + std::string(2, '\0'));
  fails("convert all.bt cells.ply", 1, "all.bt: more than 1000000000 occupied cells, too many for a cloud");
}

TEST_F(ConvertTest, AMissingFileIsOneLine) { fails("convert nowhere.ot map.bt", 1, "nowhere.ot: No such file"); }

}  // namespace
}  // namespace rhmap::test
