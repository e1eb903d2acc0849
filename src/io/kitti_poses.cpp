// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_poses.hpp"

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "rhmap/core/failure.hpp"
#include "text_line.hpp"

namespace rhmap::io {

namespace {

constexpr double kRotationTolerance = 1e-2;  // on each entry of R^T R - I; files hold 6 digits or more

/// Rest of a line as a rigid transform: 12 numbers, the rows of [R | t].
Eigen::Affine3d readTransform(TextLine& line) {
  Eigen::Matrix<double, 3, 4> rows;
  for (int k = 0; k < 12; ++k) {
    rows(k / 4, k % 4) = line.readDouble("number " + std::to_string(k + 1) + " of 12");
  }
  if (!line.word().empty()) line.fail("more than 12 numbers");
  if (!rows.allFinite()) line.fail("pose is not finite");
  const Eigen::Matrix3d rotation = rows.leftCols<3>();
  const double error = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (error > kRotationTolerance) {
    line.fail("rotation is not orthonormal: R^T R differs from the identity by " + std::to_string(error));
  }
  if (rotation.determinant() < 0) line.fail("rotation is a reflection: its determinant is negative");
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  transform.affine() = rows;
  return transform;
}

/// LiDAR to left camera, from the line `Tr: 12 numbers`; nothing if there is no such file or line.
std::optional<Eigen::Affine3d> readCalibration(const std::filesystem::path& file) {
  std::optional<Eigen::Affine3d> lidar_to_camera;
  if (!std::filesystem::exists(file)) return lidar_to_camera;
  forEachLine(file, [&lidar_to_camera](TextLine& line) {
    if (line.word() != "Tr:") return;
    if (lidar_to_camera) line.fail("a second Tr");
    lidar_to_camera = readTransform(line);
  });
  return lidar_to_camera;
}

/// Empty lines may only follow the last pose: a pose is found by the number of its line.
std::vector<Eigen::Affine3d> readPoseLines(const std::filesystem::path& file) {
  std::vector<Eigen::Affine3d> poses;
  forEachLine(file, [&poses](TextLine& line) {
    if (line.text().find_first_not_of(" \t") == std::string_view::npos) return;
    if (line.number() != poses.size() + 1) line.fail("a pose after an empty line");
    poses.push_back(readTransform(line));
  });
  return poses;
}

octomap::pose6d toPose6d(const Eigen::Affine3d& transform) {
  const Eigen::Vector3f t = transform.translation().cast<float>();
  const Eigen::Quaternionf q = Eigen::Quaterniond(transform.linear()).normalized().cast<float>();
  return {octomath::Vector3(t.x(), t.y(), t.z()), octomath::Quaternion(q.w(), q.x(), q.y(), q.z())};
}

}  // namespace

std::vector<octomap::pose6d> readKittiPoses(const std::filesystem::path& folder) {
  const auto lidar_to_camera = readCalibration(folder / "calib.txt");
  std::vector<octomap::pose6d> poses;
  for (const Eigen::Affine3d& pose : readPoseLines(folder / "poses.txt")) {
    // In double up to here: OctoMap's poses are floats, and the chain cancels most of the camera's axes.
    poses.push_back(
        toPose6d(lidar_to_camera ? lidar_to_camera->inverse(Eigen::Affine) * pose * *lidar_to_camera : pose));
  }
  return poses;
}

}  // namespace rhmap::io
