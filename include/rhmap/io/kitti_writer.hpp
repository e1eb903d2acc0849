// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace rhmap::io {

/// Writes a labelled recording in SemanticKITTI's layout, which openSequence() reads back: velodyne/NNNNNN.bin,
/// labels/NNNNNN.label, poses.txt, times.txt and calib.txt. Poses are written as KITTI's are: those of the left camera
/// in the frame of the first (calib.txt has the way from LiDAR to camera), in full precision.
///
/// Each file is written whole or not at all, the poses last: a recording that was not finished cannot be opened.
class KittiWriter {
 public:
  /// Makes the folder if need be; throws std::runtime_error if it is not empty, so that no scans of another recording
  /// are left in it, or cannot be made.
  explicit KittiWriter(const std::filesystem::path& folder);

  /// Appends a scan: points x y z [m] in the sensor frame and intensity, one label a point (low 16 bits class, high 16
  /// instance), the pose LiDAR to world [m], and the time [s]. Throws std::invalid_argument if labels and points differ
  /// in number, std::runtime_error if a file cannot be written.
  void add(std::span<const std::array<float, 4>> points, std::span<const std::uint32_t> labels,
           const Eigen::Isometry3d& pose, double time);

  /// Writes calibration, times and poses; nothing can be added after it.
  void finish();

 private:
  std::filesystem::path folder_;
  std::size_t size_ = 0;
  std::string poses_;
  std::string times_;
};

}  // namespace rhmap::io
