// SPDX-License-Identifier: BSD-3-Clause
// The same on scans of a car in a street, at full size.
#include "../octree/oracle.hpp"

#include "rhmap/baseline/octomap_mirror.hpp"

#include <gtest/gtest.h>

#include "../clip.hpp"
#include "rhmap/baseline/octomap_bridge.hpp"
#include "rhmap/io/scan_sequence.hpp"

namespace rhmap {
namespace {

using test::OctomapOracle;
using test::otBytes;

class OctomapMirrorOfScans : public testing::TestWithParam<bool> {};

TEST_P(OctomapMirrorOfScans, IsOctomapsTreeAfterEveryScan) {
  const bool lazy = GetParam();
  const auto sequence = io::openSequence(test::clipFolder());
  OcTree map(0.2);
  OctomapOracle oracle(0.2);
  OctomapMirror mirror(map);
  std::size_t blocks = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    io::Scan scan = sequence->scan(i * 8);
    scan.points.transform(scan.pose);
    map.insertPointCloud(scan.points, scan.pose.trans(), 25, lazy);
    oracle.insertPointCloud(scan.points, scan.pose.trans(), 25, lazy);
    if (lazy && i % 2 == 1) {
      map.updateInnerOccupancy();
      oracle.updateInnerOccupancy();
    }
    blocks = mirror.sync();
    ASSERT_EQ(mirror.size(), oracle.size()) << "scan " << i;
    ASSERT_TRUE(otBytes(mirror) == otBytes(oracle)) << "scan " << i;
    ASSERT_TRUE(mirror == *toOctomap(map)) << "scan " << i;
  }
  map.updateNode(10, 0, 0, true);
  EXPECT_LE(mirror.sync(), 6U) << "of " << blocks;
  EXPECT_TRUE(fromOctomap(mirror) == map);
}

INSTANTIATE_TEST_SUITE_P(Lazy, OctomapMirrorOfScans, testing::Bool());

}  // namespace
}  // namespace rhmap
