// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <sstream>

#include "rhmap/io/scan_sequence.hpp"
#include "../test_files.hpp"

namespace rhmap::io::test {
using namespace rhmap::test;
namespace {

TEST(PointFile, IsOneScanAtTheOriginWithThePointsThatOctomapReads) {
  const TempFolder folder;
  const std::string text = "-0.0434742 -4.82982 0.499645\n  1 2 3\n0 0 0\n4e0\t5 6";
  writeText(folder / "room.dat", text);
  const auto sequence = openSequence(folder / "room.dat");
  ASSERT_EQ(sequence->size(), 1u);
  EXPECT_EQ(sequence->name(0), "room");
  EXPECT_FALSE(sequence->hasLabels());
  const Scan scan = sequence->scan(0);
  EXPECT_EQ(scan.pose, octomap::pose6d());
  octomap::Pointcloud expected;
  std::istringstream stream(text);
  expected.read(stream);
  ASSERT_EQ(expected.size(), 4u);
  expectSamePoints(scan.points, expected);
}

TEST(PointFile, SkipsCommentsEmptyLinesAndFurtherColumns) {
  const TempFolder folder;
  writeText(folder / "room.xyz", "# x y z r g b\n\n1 2 3 255 0 0\r\n \t\r\n4 5 nan\n");
  const Scan scan = openSequence(folder / "room.xyz")->scan(0);
  ASSERT_EQ(scan.points.size(), 1u);
  EXPECT_EQ(scan.points[0], octomap::point3d(1, 2, 3));
  EXPECT_EQ(scan.dropped, 1u);
}

TEST(PointFile, ABadLineIsNamed) {
  const TempFolder folder;
  writeText(folder / "room.xyz", "1 2 3\n1 2\n");
  expectMessage(messageOf([&] { openSequence(folder / "room.xyz"); }),
                {"room.xyz", "line 2", "z of a point is missing"});
}

TEST(PointFile, AFileWithoutPointsIsAnError) {
  const TempFolder folder;
  writeText(folder / "room.xyz", "# nothing\n");
  expectMessage(messageOf([&] { openSequence(folder / "room.xyz"); }), {"room.xyz", "holds no points"});
}

}  // namespace
}  // namespace rhmap::io::test
