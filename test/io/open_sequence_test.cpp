// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "rhmap/io/scan_sequence.hpp"
#include "../test_files.hpp"

namespace rhmap::io::test {
using namespace rhmap::test;
namespace {

TEST(OpenSequence, AnUnknownKindIsAnErrorThatNamesTheSupportedOnes) {
  const TempFolder folder;
  writeText(folder / "cloud.pcd", "VERSION 0.7");
  expectMessage(messageOf([&] { openSequence(folder / "cloud.pcd"); }),
                {"cloud.pcd", "KITTI", "SemanticKITTI", ".graph", ".log", ".dat", ".xyz"});
}

TEST(OpenSequence, AMissingFileIsAnError) {
  const TempFolder folder;
  expectMessage(messageOf([&] { openSequence(folder / "none.graph"); }), {"none.graph", "no such file or folder"});
}

TEST(OpenSequence, ExtensionsMayBeInCapitals) {
  const TempFolder folder;
  writeText(folder / "ROOM.XYZ", "1 2 3\n");
  EXPECT_EQ(openSequence(folder / "ROOM.XYZ")->size(), 1u);
}

}  // namespace
}  // namespace rhmap::io::test
