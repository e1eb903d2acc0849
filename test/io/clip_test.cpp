// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "rhmap/io/scan_sequence.hpp"
#include "../test_files.hpp"

namespace rhmap::io::test {
using namespace rhmap::test;
namespace {

struct Outcome {
  int status;
  std::string output;  // stdout and stderr
};

Outcome unpack(const std::filesystem::path& to) {
  const std::string command = "sh '" RHMAP_DATA_DIR "/unpack.sh' '" + to.string() + "' 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {-1, "popen failed"};
  Outcome outcome{0, ""};
  std::array<char, 256> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) outcome.output += buffer.data();
  outcome.status = pclose(pipe);
  return outcome;
}

TEST(Clip, UnpacksOnceIsLeftAloneThenAndLeavesNothingElse) {
  const TempFolder folder;
  const Outcome first = unpack(folder.path());
  ASSERT_EQ(first.status, 0) << first.output;
  expectMessage(first.output, {"unpacked into", "kitti_raw_0005", "maps"});

  const auto scan = folder / "kitti_raw_0005/velodyne/000000.bin";
  const auto before = std::filesystem::last_write_time(scan);
  const Outcome second = unpack(folder.path());
  EXPECT_EQ(second.status, 0);
  expectMessage(second.output, {"already unpacked"});
  EXPECT_EQ(std::filesystem::last_write_time(scan), before);

  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++entries;
  EXPECT_EQ(entries, 2u);

  // A file that was damaged is noticed, not mended silently.
  std::filesystem::resize_file(scan, 16);
  const Outcome damaged = unpack(folder.path());
  EXPECT_NE(damaged.status, 0);
  expectMessage(damaged.output, {"kitti_raw_0005", "remove it first"});
}

TEST(Clip, DoesNotTouchAFolderThatIsNotItsOwn) {
  const TempFolder folder;
  writeText(folder / "kitti_raw_0005/poses.txt", "mine");
  const Outcome outcome = unpack(folder.path());
  EXPECT_NE(outcome.status, 0);
  expectMessage(outcome.output, {"kitti_raw_0005", "remove it first"});
  EXPECT_EQ(readText(folder / "kitti_raw_0005/poses.txt"), "mine");
}

TEST(Clip, HoldsWhatItsReadmeSays) {
  const TempFolder folder;
  const Outcome outcome = unpack(folder.path());
  ASSERT_EQ(outcome.status, 0) << outcome.output;

  const auto sequence = openSequence(folder / "kitti_raw_0005");
  ASSERT_EQ(sequence->size(), 44u);
  EXPECT_TRUE(sequence->hasLabels());
  std::map<std::uint32_t, std::size_t> classes;
  octomap::pose6d last;
  for (std::size_t i = 0; i < sequence->size(); ++i) {
    const Scan scan = sequence->scan(i);
    EXPECT_EQ(scan.dropped, 1u) << "scan " << i;
    EXPECT_GT(scan.points.size(), 90000u) << "scan " << i;
    ASSERT_EQ(scan.labels.size(), scan.points.size()) << "scan " << i;
    for (const std::uint32_t label : scan.labels) ++classes[label & 0xffff];

    if (i == 0) {
      EXPECT_EQ(scan.pose, octomap::pose6d());
    } else {
      EXPECT_GT(scan.pose.x(), last.x()) << "scan " << i;
      EXPECT_LT(last.distance(scan.pose), 1.0) << "scan " << i;  // 10 Hz, at most 7 m/s
    }
    last = scan.pose;
  }
  EXPECT_GT(classes[252], 1000u);  // the van
  EXPECT_GT(classes[253], 1000u);  // the cyclist
  EXPECT_GT(classes[9], 1000000u);

  EXPECT_EQ(openSequence(folder / "maps/scan.dat")->scan(0).points.size(), 88206u);
}

}  // namespace
}  // namespace rhmap::io::test
