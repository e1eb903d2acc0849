// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "kitti_folder.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "../test_files.hpp"

namespace rhmap::io::test {
using namespace rhmap::test;
namespace {

using KittiPoses = KittiFolder;

TEST_F(KittiPoses, APartOfARecordingFindsItsPosesByTheScansNumber) {
  writeScans({"000002", "000004"});
  writePoses(6);
  const auto sequence = openSequence(folder_.path());
  EXPECT_EQ(sequence->scan(0).pose.trans(), octomap::point3d(20, 0, 0));
  EXPECT_EQ(sequence->scan(1).pose.trans(), octomap::point3d(40, 0, 0));
}

TEST_F(KittiPoses, PosesGoByOrderIfNumbersExceedTheLinesButCountsAgree) {
  writeScans({"004390", "004391"});
  writePoses(2);
  const auto sequence = openSequence(folder_.path());
  EXPECT_EQ(sequence->scan(0).pose.trans(), octomap::point3d(0, 0, 0));
  EXPECT_EQ(sequence->scan(1).pose.trans(), octomap::point3d(10, 0, 0));
}

TEST_F(KittiPoses, PosesGoByOrderOfNamesThatAreNoNumbers) {
  writeScans({"b", "a"});
  writePoses(2);
  const auto sequence = openSequence(folder_.path());
  EXPECT_EQ(sequence->name(0), "a");
  EXPECT_EQ(sequence->scan(1).pose.trans(), octomap::point3d(10, 0, 0));
}

TEST_F(KittiPoses, IdentityPosesAreExact) {
  writeScans({"000000"});
  writePoses(1);
  const octomap::pose6d pose = openSequence(folder_.path())->scan(0).pose;
  EXPECT_EQ(pose, octomap::pose6d());
}

TEST_F(KittiPoses, WithoutCalibrationPosesAreOfTheLidar) {
  writeScan("000000", {1, 2, 3, 0});
  writeText(folder_ / "poses.txt", "0 -1 0 7\t1 0 0 8 0 0 1 9\r\n\n \n");  // a quarter turn to the left
  writeText(folder_ / "calib.txt", "P0: 1 0 0 0 0 1 0 0 0 0 1 0\n");       // no Tr
  const Scan scan = openSequence(folder_.path())->scan(0);
  const octomap::point3d world = scan.pose.transform(scan.points[0]);
  EXPECT_LT((world - octomap::point3d(7 - 2, 8 + 1, 9 + 3)).norm(), 1e-5);
}

TEST_F(KittiPoses, WithCalibrationTheLidarsPoseIsTrInverseTimesPTimesTr) {
  // Camera axes: x right, y down, z ahead; the camera is 0.25 m ahead of the LiDAR and 0.5 m below it.
  writeText(folder_ / "calib.txt", "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: 0 -1 0 0 0 0 -1 -0.5 1 0 0 -0.25\n");
  // The camera drives 3 m ahead, then turns left by 90 degrees: its z axis points to the old -x.
  writeText(folder_ / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 3\n0 0 -1 0 0 1 0 0 1 0 0 3\n");
  writeScan("000000", {5, 0, 0, 0});
  writeScan("000001", {5, 0, 0, 0});
  const auto sequence = openSequence(folder_.path());
  const Scan ahead = sequence->scan(0);
  EXPECT_LT((ahead.pose.transform(ahead.points[0]) - octomap::point3d(8, 0, 0)).norm(), 1e-5);
  // By hand: the camera stands at (3.25, 0, -0.5) in the LiDAR's first frame; the LiDAR 0.25 m behind it, which is now
  // -y, and 0.5 m above it; it looks along +y.
  const Scan turned = sequence->scan(1);
  EXPECT_LT((turned.pose.trans() - octomap::point3d(3.25f, -0.25f, 0)).norm(), 1e-5);
  EXPECT_LT((turned.pose.transform(turned.points[0]) - octomap::point3d(3.25f, 4.75f, 0)).norm(), 1e-5);
}

TEST_F(KittiPoses, TheChainIsThatOfDoubleMatricesForRandomPoses) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto randomPose = [&] {
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();
    pose.linear() = Eigen::Quaterniond(uniform(generator), uniform(generator), uniform(generator), uniform(generator))
                        .normalized()
                        .toRotationMatrix();
    pose.translation() << 100 * uniform(generator), 100 * uniform(generator), uniform(generator);
    return pose;
  };
  const Eigen::Affine3d calibration = randomPose();
  std::vector<Eigen::Affine3d> poses;
  std::string text;
  for (int k = 0; k < 20; ++k) {
    poses.push_back(randomPose());
    text += poseLine(poses.back());
    writeScan(std::to_string(k), {30, -20, 2, 0});
  }
  writeText(folder_ / "poses.txt", text);
  writeText(folder_ / "calib.txt", "Tr: " + poseLine(calibration));
  const auto sequence = openSequence(folder_.path());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Eigen::Vector3d expected = calibration.inverse() * poses[k] * calibration * Eigen::Vector3d(30, -20, 2);
    const Scan scan = sequence->scan(k);
    const octomap::point3d actual = scan.pose.transform(scan.points[0]);
    const Eigen::Vector3d error = Eigen::Vector3d(actual.x(), actual.y(), actual.z()) - expected;
    EXPECT_LT(error.norm(), 1e-4) << "scan " << k;
  }
}

TEST_F(KittiPoses, AMissingPoseFileIsAnError) {
  writeScans({"000000"});
  expectMessage(openMessage(), {"poses.txt", "no such file"});
}

TEST_F(KittiPoses, TooFewPosesAreAnError) {
  writeScans({"000000", "000001", "000002"});
  writePoses(2);
  expectMessage(openMessage(), {"poses.txt", "holds 2 poses", "scan 000002", "3 scans"});
}

TEST_F(KittiPoses, NamesThatAreNoNumbersNeedAsManyPoses) {
  writeScans({"000000", "first"});
  writePoses(9);
  expectMessage(openMessage(), {"poses.txt", "holds 9 poses", "first", "not a number"});
}

TEST_F(KittiPoses, ABadPoseLineIsNamed) {
  const std::string good = poseLine(0, 0, 0);
  writeScans({"000000"});
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"1 0 0 0 0 1 0 0 0 0 1\n", "number 12 of 12 is missing"},
      {"1 0 0 0 0 1 0 0 0 0 1 0 5\n", "more than 12 numbers"},
      {"1 0 0 0 0 1 0 zero 0 0 1 0\n", "number 8 of 12 is not a number: 'zero'"},
      {"1 0 0 0 0 1 0 0 0 0 1 0x\n", "number 12 of 12 is not a number: '0x'"},
      {"1 0 0 1e999 0 1 0 0 0 0 1 0\n", "number 4 of 12 is out of range: '1e999'"},
      {"1 0 0 nan 0 1 0 0 0 0 1 0\n", "pose is not finite"},
      {"1 0 0 0 0 1 0 -inf 0 0 1 0\n", "pose is not finite"},
      {"1.1 0 0 0 0 1 0 0 0 0 1 0\n", "rotation is not orthonormal"},
      {"1 0.2 0 0 0 1 0 0 0 0 1 0\n", "rotation is not orthonormal"},
      {"0 0 0 0 0 0 0 0 0 0 0 0\n", "rotation is not orthonormal"},
      {"1 0 0 0 0 1 0 0 0 0 -1 0\n", "rotation is a reflection"},
  };
  for (const auto& [line, reason] : cases) {
    writeText(folder_ / "poses.txt", good + line + good);
    expectMessage(openMessage(), {"poses.txt", "line 2", reason});
  }
}

TEST_F(KittiPoses, RoundedRotationsAreAccepted) {
  writeScans({"000000"});
  writeText(folder_ / "poses.txt", "0.866 -0.5 0 1 0.5 0.866 0 2 0 0 1 3\n");
  const octomap::pose6d pose = openSequence(folder_.path())->scan(0).pose;
  EXPECT_NEAR(pose.rot().norm(), 1.0, 1e-6);
  EXPECT_NEAR(pose.yaw(), 0.5236, 1e-3);
}

TEST_F(KittiPoses, AnEmptyLineBetweenPosesIsAnError) {
  writeScans({"000000"});
  writeText(folder_ / "poses.txt", poseLine(0, 0, 0) + "\n" + poseLine(1, 0, 0));
  expectMessage(openMessage(), {"poses.txt", "line 3", "after an empty line"});
}

TEST_F(KittiPoses, ABadCalibrationIsNamed) {
  writeScans({"000000"});
  writePoses(1);
  writeText(folder_ / "calib.txt", "P0: 1 2 3\nTr: 1 0 0\n");
  expectMessage(openMessage(), {"calib.txt", "line 2", "number 4 of 12 is missing"});
  writeText(folder_ / "calib.txt", "Tr: 2 0 0 0 0 1 0 0 0 0 1 0\n");
  expectMessage(openMessage(), {"calib.txt", "line 1", "rotation is not orthonormal"});
  writeText(folder_ / "calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  expectMessage(openMessage(), {"calib.txt", "line 2", "a second Tr"});
}

}  // namespace
}  // namespace rhmap::io::test
