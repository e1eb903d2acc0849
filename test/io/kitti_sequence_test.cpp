// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <thread>

#include "kitti_folder.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "../test_files.hpp"

namespace rhmap::io::test {
using namespace rhmap::test;
namespace {

using KittiSequence = KittiFolder;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST_F(KittiSequence, ReadsPointsInTheOrderOfTheFile) {
  writeScan("000000", {1, 2, 3, 0.5f, -4, 5.25f, -6, 1});
  writePoses(1);
  const auto sequence = openSequence(folder_.path());
  const Scan scan = sequence->scan(0);
  ASSERT_EQ(scan.points.size(), 2u);
  EXPECT_EQ(scan.points[0], octomap::point3d(1, 2, 3));
  EXPECT_EQ(scan.points[1], octomap::point3d(-4, 5.25f, -6));
  EXPECT_EQ(scan.dropped, 0u);
  EXPECT_FALSE(sequence->hasLabels());
  EXPECT_TRUE(scan.labels.empty());
}

TEST_F(KittiSequence, LeavesOutNoReturnPointsTogetherWithTheirLabels) {
  writeScan("000000", {0, 0, 0, 0.9f, 1, 0, 0, 0, -0.0f, 0, -0.0f, 0, 0, 0, 2, 0});
  writeLabels("000000", {70, 71, 72, (5u << 16) | 252});
  writePoses(1);
  const auto sequence = openSequence(folder_.path());
  EXPECT_TRUE(sequence->hasLabels());
  const Scan scan = sequence->scan(0);
  ASSERT_EQ(scan.points.size(), 2u);
  EXPECT_EQ(scan.points[0], octomap::point3d(1, 0, 0));
  EXPECT_EQ(scan.points[1], octomap::point3d(0, 0, 2));
  EXPECT_EQ(scan.labels, (std::vector<std::uint32_t>{71, (5u << 16) | 252}));
  EXPECT_EQ(scan.dropped, 2u);
}

TEST_F(KittiSequence, LeavesOutNonFinitePointsTogetherWithTheirLabels) {
  writeScan("000000", {kNan, 1, 1, 0, 1, kInf, 1, 0, 1, 1, -kInf, 0, 1, 1, 1, kNan});
  writeLabels("000000", {1, 2, 3, 4});
  writePoses(1);
  const Scan scan = openSequence(folder_.path())->scan(0);
  EXPECT_EQ(scan.points.size(), 1u);
  EXPECT_EQ(scan.labels, std::vector<std::uint32_t>{4});
  EXPECT_EQ(scan.dropped, 3u);
}

TEST_F(KittiSequence, AScanWithoutPointsIsEmpty) {
  writeScan("000000", {});
  writePoses(1);
  EXPECT_EQ(openSequence(folder_.path())->scan(0).points.size(), 0u);
}

TEST_F(KittiSequence, ListsScansByNumberAndIgnoresOtherFiles) {
  writeScans({"10", "9", "000002"});
  writeText(folder_ / "velodyne/readme.txt", "not a scan");
  writePoses(11);
  const auto sequence = openSequence(folder_.path());
  ASSERT_EQ(sequence->size(), 3u);
  EXPECT_EQ(sequence->name(0), "000002");
  EXPECT_EQ(sequence->name(1), "9");
  EXPECT_EQ(sequence->name(2), "10");
}

TEST_F(KittiSequence, CanBeReadFromSeveralThreads) {
  writeScans({"0", "1", "2", "3"});
  writePoses(4);
  const auto sequence = openSequence(folder_.path());
  std::vector<std::thread> threads;
  std::vector<float> sums(4);
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < 40; ++i) sums[t] += sequence->scan(i % 4).points[0].x();
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(sums, std::vector<float>(4, 60.0f));
}

TEST_F(KittiSequence, AnIndexPastTheEndIsOutOfRange) {
  writeScans({"000000"});
  writePoses(1);
  const auto sequence = openSequence(folder_.path());
  EXPECT_THROW(sequence->scan(1), std::out_of_range);
  EXPECT_THROW(sequence->name(1), std::out_of_range);
}

TEST_F(KittiSequence, AFolderWithoutVelodyneIsAnError) {
  writePoses(1);
  expectMessage(openMessage(), {"velodyne", "no such folder"});
}

TEST_F(KittiSequence, AFolderWithoutScansIsAnError) {
  writeText(folder_ / "velodyne/readme.txt", "no scan");
  writePoses(1);
  expectMessage(openMessage(), {"velodyne", "holds no scans"});
}

TEST_F(KittiSequence, AScanThatIsCutOffIsAnError) {
  writeScan("000000", {1, 2, 3, 0.5f, 1, 2, 3});
  writePoses(1);
  expectMessage(scanMessage(0), {"000000.bin", "28 bytes", "points of 16 bytes"});
}

TEST_F(KittiSequence, AScanThatIsAFolderIsAnError) {
  std::filesystem::create_directories(folder_ / "velodyne/000000.bin");
  writePoses(1);
  expectMessage(scanMessage(0), {"000000.bin", "cannot be read"});
}

TEST_F(KittiSequence, AScanThatWentAwayIsAnError) {
  writeScans({"000000"});
  writePoses(1);
  const auto sequence = openSequence(folder_.path());
  std::filesystem::remove(folder_ / "velodyne/000000.bin");
  expectMessage(messageOf([&] { sequence->scan(0); }), {"000000.bin", "cannot be read"});
}

TEST_F(KittiSequence, AMissingLabelFileIsAnError) {
  writeScans({"000000", "000001"});
  writeLabels("000000", {9});
  writePoses(2);
  expectMessage(openMessage(), {"000001.label", "no such file"});
}

TEST_F(KittiSequence, ALabelCountThatIsNotThePointCountIsAnError) {
  writeScans({"000000"});
  writeLabels("000000", {9, 9});
  writePoses(1);
  expectMessage(scanMessage(0), {"000000.label", "2 labels for 1 points"});
}

TEST_F(KittiSequence, ALabelFileThatIsCutOffIsAnError) {
  writeScans({"000000"});
  writeText(folder_ / "labels/000000.label", "abcdef");
  writePoses(1);
  expectMessage(scanMessage(0), {"000000.label", "6 bytes", "labels of 4 bytes"});
}

}  // namespace
}  // namespace rhmap::io::test
