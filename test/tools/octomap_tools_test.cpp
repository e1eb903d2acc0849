// SPDX-License-Identifier: BSD-3-Clause
// OctoMap's own programs (Debian's octomap-tools) write what rhmap writes, and read it.
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

}  // namespace
}  // namespace rhmap::test
