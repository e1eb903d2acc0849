// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/Pointcloud.h>
#include <octomap/octomap_types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rhmap::io {

/// One sweep of a range sensor and where the sensor stood; `points` and `pose` fit OctoMap's insertPointCloud.
struct Scan {
  octomap::Pointcloud points;         ///< Returns in the sensor frame [m], in the order of the file.
  octomap::pose6d pose;               ///< Sensor to world [m].
  std::vector<std::uint32_t> labels;  ///< One a point, or empty; SemanticKITTI: low 16 bits class, high 16 instance.
  std::size_t dropped = 0;            ///< Returns left out: non-finite, or KITTI's "no return" at exactly (0,0,0).
};

/// Recorded scans in the order of time; const calls may come from several threads at once.
class ScanSequence {
 public:
  ScanSequence() = default;
  ScanSequence(const ScanSequence&) = delete;
  ScanSequence& operator=(const ScanSequence&) = delete;
  virtual ~ScanSequence() = default;

  /// Number of scans, at least one.
  virtual std::size_t size() const = 0;

  /// Scan i (may read from disk); std::out_of_range if i >= size(), std::runtime_error if its file cannot be read.
  virtual Scan scan(std::size_t i) const = 0;

  /// What the recording calls scan i, e.g. "004390" for KITTI's velodyne/004390.bin.
  virtual std::string name(std::size_t i) const = 0;

  /// True if every scan comes with labels; a Scan's `labels` are empty otherwise.
  virtual bool hasLabels() const { return false; }
};

/// Opens a recording; throws std::runtime_error that names file, line or byte, and reason.
///
/// - A folder in KITTI's or SemanticKITTI's layout: velodyne/NNNNNN.bin, poses.txt, and optionally labels/NNNNNN.label
///   and calib.txt. Poses are LiDAR to world; if calib.txt has a line `Tr:` they are those of the left camera, as in
///   KITTI odometry, and the LiDAR's pose is Tr^-1 * P * Tr. Scan NNNNNN has the pose in line NNNNNN (from 0), so a
///   part of a recording works; if there is no such line or a name is not a number, scans and poses pair up in order,
///   provided that there are as many of both.
/// - `.graph`: OctoMap's binary scan graph. `.log`: OctoMap's plain text (NODE x y z roll pitch yaw, then points).
/// - `.dat`, `.xyz`: one scan of bare lines `x y z`, its pose the identity.
///
/// OctoMap's formats keep returns at (0,0,0), as OctoMap does.
std::unique_ptr<ScanSequence> openSequence(const std::filesystem::path& path);

}  // namespace rhmap::io
