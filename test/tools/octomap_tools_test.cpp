// SPDX-License-Identifier: BSD-3-Clause
// OctoMap's own programs (Debian's octomap-tools) write what rhmap writes, and read it.
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace rhmap::test {
namespace {

using OctomapTools = ProgramTest;

TEST_F(OctomapTools, Graph2treeWritesTheSameBytes) {
  for (const std::string resolution : {"0.05", "0.1", "0.5"}) {
    const Outcome theirs = shell("graph2tree -i data/maps/spherical_scan.graph -o theirs.bt -m 2.5 -res " + resolution);
    ASSERT_EQ(theirs.exit_code, 0) << theirs.err;
    runs("build data/maps/spherical_scan.graph ours.bt ours.ot --max-range 2.5 --resolution " + resolution);
    EXPECT_TRUE(bytes("ours.bt") == bytes("theirs.bt")) << resolution;
    EXPECT_TRUE(bytes("ours.ot") == bytes("theirs.bt.ot")) << resolution;
  }
}

TEST_F(OctomapTools, ConvertOctreeReadsWhatRhmapWrites) {
  runs("build data/maps/spherical_scan.graph ours.bt ours.ot");
  const Outcome read_ot = shell("convert_octree ours.ot back.bt");
  ASSERT_EQ(read_ot.exit_code, 0) << read_ot.err;
  EXPECT_TRUE(bytes("back.bt") == bytes("ours.bt"));
  const Outcome compared = shell("compare_octrees ours.ot ours.ot");
  EXPECT_EQ(compared.exit_code, 0) << compared.err;
}

TEST_F(OctomapTools, ReadMapsWithoutWhatMoved) {
  runs("simulate street street --beams 16 --frames 4");
  runs("clean street clean.bt clean.ot --resolution 0.2 --max-range 30");
  const Outcome converted = shell("convert_octree clean.ot back.bt");
  ASSERT_EQ(converted.exit_code, 0) << converted.err;
  EXPECT_TRUE(bytes("back.bt") == bytes("clean.bt"));
  const Outcome compared = shell("compare_octrees clean.ot clean.ot");
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_NE((compared.out + compared.err).find("KLD: 0\n"), std::string::npos) << compared.out << compared.err;
}

TEST_F(OctomapTools, Bt2vrmlDrawsEveryOccupiedLeaf) {
  runs("build data/maps/spherical_scan.graph ours.bt");
  const Outcome drawn = shell("bt2vrml ours.bt");
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  const auto info = nlohmann::json::parse(runs("info ours.bt --json -"));
  const std::string written = "Finished writing " + std::to_string(info["occupied_leaves"].get<int>()) + " voxels";
  EXPECT_NE((drawn.out + drawn.err).find(written), std::string::npos) << drawn.out << drawn.err;
  EXPECT_NE(bytes("ours.bt.wrl").find("Box"), std::string::npos);
}

TEST_F(OctomapTools, EditOctreeWritesTheMapThatItHasRead) {
  runs("build data/maps/spherical_scan.graph ours.bt");
  const Outcome edited = shell("edit_octree -o theirs.bt ours.bt");
  ASSERT_EQ(edited.exit_code, 0) << edited.err;
  EXPECT_TRUE(bytes("theirs.bt") == bytes("ours.bt"));
}

}  // namespace
}  // namespace rhmap::test
