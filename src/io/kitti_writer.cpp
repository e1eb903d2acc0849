// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/io/kitti_writer.hpp"

#include <charconv>
#include <ostream>
#include <stdexcept>
#include <system_error>

#include "binary_file.hpp"
#include "rhmap/core/atomic_file.hpp"
#include "rhmap/core/failure.hpp"

namespace rhmap::io {

namespace {

namespace fs = std::filesystem;

/// LiDAR to left camera: axes x right, y down, z ahead; mounted about as in KITTI's car.
Eigen::Isometry3d lidarToCamera() {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.matrix() << 0, -1, 0, 0,  //
      0, 0, -1, -0.08,                //
      1, 0, 0, -0.27,                 //
      0, 0, 0, 1;
  return transform;
}

/// Shortest text that gives the same double back, in any locale.
std::string toText(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

std::string toText(const Eigen::Isometry3d& transform) {
  std::string line;
  for (int k = 0; k < 12; ++k) {
    const double value = transform.matrix()(k / 4, k % 4);
    if (k > 0) line += ' ';
    line += toText(value == 0 ? 0 : value);  // no "-0"
  }
  line += '\n';
  return line;
}

std::string toName(std::size_t number) {
  std::string digits = std::to_string(number);
  if (digits.size() < 6) digits.insert(0, 6 - digits.size(), '0');
  return digits;
}

template <typename T>
void writeValues(const fs::path& file, std::span<const T> values) {
  writeFileWhole(file, [values](std::ostream& out) {
    out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
  });
}

void writeText(const fs::path& file, const std::string& text) {
  writeFileWhole(file, [&text](std::ostream& out) { out << text; });
}

}  // namespace

KittiWriter::KittiWriter(const fs::path& folder) : folder_(folder) {
  std::error_code error;
  if (fs::exists(folder_, error) && !fs::is_directory(folder_, error)) failOnFile(folder_, "is no folder");
  if (fs::is_directory(folder_, error) && !fs::is_empty(folder_, error))
    failOnFile(folder_, error ? "cannot be read: " + error.message() : "is not empty");
  for (const char* name : {"velodyne", "labels"}) {
    fs::create_directories(folder_ / name, error);
    if (error) failOnFile(folder_ / name, "cannot be made: " + error.message());
  }
}

void KittiWriter::add(std::span<const std::array<float, 4>> points, std::span<const std::uint32_t> labels,
                      const Eigen::Isometry3d& pose, double time) {
  if (points.size() != labels.size()) {
    throw std::invalid_argument("KittiWriter: " + std::to_string(labels.size()) + " labels for " +
                                std::to_string(points.size()) + " points");
  }
  const std::string name = toName(size_);
  writeValues(folder_ / "velodyne" / (name + ".bin"), points);
  writeValues(folder_ / "labels" / (name + ".label"), labels);
  const Eigen::Isometry3d lidar_to_camera = lidarToCamera();
  poses_ += toText(lidar_to_camera * pose * lidar_to_camera.inverse());
  times_ += toText(time);
  times_ += '\n';
  ++size_;
}

void KittiWriter::finish() {
  writeText(folder_ / "calib.txt", "Tr: " + toText(lidarToCamera()));
  writeText(folder_ / "times.txt", times_);
  writeText(folder_ / "poses.txt", poses_);
}

}  // namespace rhmap::io
