// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "rhmap/core/key_set.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap::tools {

/// The maps that a report shows, all of one resolution.
struct ReportMaps {
  const OcTree* everything = nullptr;  ///< every cube that was ever hit
  const OcTree* octomap = nullptr;     ///< what OctoMap's rays leave of it
  const OcTree* cleaned = nullptr;     ///< what the removal leaves of it
  KeySet moving;                       ///< cells of what moved, by the labels; empty without labels
  bool has_labels = false;
  std::vector<Eigen::Vector3d> path;  ///< of the sensor [m]
};

/// A picture of the report.
struct ReportPicture {
  std::string name;     ///< of its file, without the extension
  std::string caption;  ///< for people
  std::string png;
};

/// The three maps from one place, with what is left of what moved in red, and from above what the removal changed.
std::vector<ReportPicture> drawPictures(const ReportMaps& maps);

}  // namespace rhmap::tools
