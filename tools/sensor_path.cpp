// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_path.hpp"

namespace rhmap::tools {

std::vector<Eigen::Vector3d> sensorPath(const io::ScanSequence& sequence, const FrameRange& frames) {
  std::vector<Eigen::Vector3d> path;
  for (std::size_t i = frames.first; i <= frames.last; ++i) {
    const octomap::point3d at = sequence.scan(i).pose.trans();
    path.emplace_back(at.x(), at.y(), at.z());
  }
  return path;
}

}  // namespace rhmap::tools
