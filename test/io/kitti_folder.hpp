// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "rhmap/io/scan_sequence.hpp"
#include "../test_files.hpp"

namespace rhmap::io::test {
using namespace rhmap::test;

inline std::string poseLine(double x, double y, double z) {
  std::ostringstream line;
  line << "1 0 0 " << x << " 0 1 0 " << y << " 0 0 1 " << z << "\n";
  return line.str();
}

inline std::string poseLine(const Eigen::Affine3d& pose) {
  std::ostringstream line;
  line << std::setprecision(17);
  for (int k = 0; k < 12; ++k) line << (k > 0 ? " " : "") << pose.matrix()(k / 4, k % 4);
  return line.str() + "\n";
}

/// A folder with one point (k, 0, 0.5) in scan k, no labels, and pose k at (10 k, 0, 0).
class KittiFolder : public testing::Test {
 protected:
  void writeScans(std::initializer_list<const char*> names) {
    float k = 0;
    for (const char* name : names) writeScan(name, {k++, 0, 0.5f, 0.3f});
  }

  void writeScan(const std::string& name, const std::vector<float>& values) {
    writeValues(folder_.path() / "velodyne" / (name + ".bin"), values);
  }

  void writeLabels(const std::string& name, const std::vector<std::uint32_t>& labels) {
    writeValues(folder_.path() / "labels" / (name + ".label"), labels);
  }

  void writePoses(int count) {
    std::string text;
    for (int k = 0; k < count; ++k) text += poseLine(10 * k, 0, 0);
    writeText(folder_ / "poses.txt", text);
  }

  std::string openMessage() const {
    return messageOf([this] { openSequence(folder_.path()); });
  }

  std::string scanMessage(std::size_t i) const {
    const auto sequence = openSequence(folder_.path());
    return messageOf([&] { sequence->scan(i); });
  }

  TempFolder folder_;
};

}  // namespace rhmap::io::test
