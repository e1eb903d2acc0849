// SPDX-License-Identifier: BSD-3-Clause
// What is simulated, written and read again is the same: points, labels and poses in the world.
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <vector>

#include "../test_files.hpp"
#include "rhmap/io/kitti_writer.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "rhmap/sim/simulation.hpp"

namespace rhmap::sim::test {
namespace {

using rhmap::test::TempFolder;

/// A pose of OctoMap's floats and the one that it stands for.
void expectSamePose(const octomap::pose6d& actual, const Eigen::Isometry3d& expected) {
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(30, 0, 0), Eigen::Vector3d(0, 20, 5)}) {
    const octomap::point3d there = actual.transform(
        octomap::point3d(static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z())));
    EXPECT_LT((Eigen::Vector3d(there.x(), there.y(), there.z()) - expected * point).norm(), 1e-4);
  }
}

TEST(SimulatedSequence, IsReadBackAsItWasMade) {
  for (const std::string scene : {"hill", "drive"}) {  // tilted, and turning
    const TempFolder temp;
    const auto folder = temp / "sequence";
    const Simulation simulation({.scene = scene,
                                 .frames = 3,
                                 .rate = scene == "hill" ? 0.1 : 0.01,
                                 .pose_noise = 0.2,
                                 .lidar = {.beams = 16, .no_returns = NoReturns::kZero}});
    io::KittiWriter writer(folder);
    for (std::size_t k = 0; k < 3; ++k) {
      const LidarScan scan = simulation.scan(k);
      writer.add(scan.points, scan.labels, simulation.toldPose(k), simulation.time(k));
    }
    EXPECT_THROW(io::openSequence(folder), std::runtime_error) << "unfinished: no poses yet";
    writer.finish();

    const auto sequence = io::openSequence(folder);
    ASSERT_EQ(sequence->size(), 3u);
    EXPECT_TRUE(sequence->hasLabels());
    for (std::size_t k = 0; k < 3; ++k) {
      const io::Scan read = sequence->scan(k);
      const LidarScan made = simulation.scan(k);
      std::size_t at = 0, zeros = 0;
      for (std::size_t i = 0; i < made.points.size(); ++i) {
        const auto& point = made.points[i];
        if (point == std::array<float, 4>{0, 0, 0, 0}) {
          ++zeros;
          continue;
        }
        ASSERT_EQ(read.points[at], octomap::point3d(point[0], point[1], point[2]));
        ASSERT_EQ(read.labels[at], made.labels[i]);
        ++at;
      }
      EXPECT_EQ(read.points.size(), at);
      EXPECT_EQ(read.dropped, zeros);
      EXPECT_GT(zeros, 0u);
      expectSamePose(read.pose, simulation.toldPose(k));
    }
    EXPECT_EQ(rhmap::test::readText(folder / "times.txt"), scene == "hill" ? "0\n10\n20\n" : "0\n100\n200\n");
  }
}

/// KITTI's camera looks along z with y down, so 8 m ahead is 8 m of z.
TEST(KittiWriter, WritesThePosesOfTheCamera) {
  const TempFolder temp;
  io::KittiWriter writer(temp / "a");
  writer.add({}, {}, Eigen::Isometry3d::Identity(), 0);
  writer.add({}, {}, Eigen::Isometry3d(Eigen::Translation3d(8, 2, 1)), 0.1);
  writer.finish();
  EXPECT_EQ(rhmap::test::readText(temp.path() / "a/poses.txt"), "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 -2 0 1 0 -1 0 0 1 8\n");
  EXPECT_EQ(rhmap::test::readText(temp.path() / "a/calib.txt"), "Tr: 0 -1 0 0 0 0 -1 -0.08 1 0 0 -0.27\n");
}

TEST(KittiWriter, KeepsOutOfFoldersThatAreInUse) {
  const TempFolder temp;
  rhmap::test::writeText(temp.path() / "a/velodyne/000000.bin", "");
  rhmap::test::expectMessage(rhmap::test::messageOf([&] { io::KittiWriter writer(temp / "a"); }),
                             {(temp / "a").string(), "is not empty"});
  rhmap::test::expectMessage(
      rhmap::test::messageOf([&] { io::KittiWriter writer(temp.path() / "a/velodyne/000000.bin"); }), {"is no folder"});
}

TEST(KittiWriter, WantsALabelForEveryPoint) {
  const TempFolder temp;
  io::KittiWriter writer(temp / "a");
  const std::vector<std::array<float, 4>> points(2);
  const std::vector<std::uint32_t> labels(1);
  EXPECT_THROW(writer.add(points, labels, Eigen::Isometry3d::Identity(), 0), std::invalid_argument);
}

}  // namespace
}  // namespace rhmap::sim::test
