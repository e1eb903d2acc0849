// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "free_space.hpp"
#include "ground.hpp"
#include "keyframes.hpp"
#include "moving_hits.hpp"
#include "range_image.hpp"
#include "region_map.hpp"
#include "rhmap/octree/scan_masks.hpp"
#include "rhmap/removal/rh_map.hpp"
#include "scan_context.hpp"
#include "scan_points.hpp"
#include "scan_to_map.hpp"
#include "scan_trace.hpp"

namespace rhmap {

/// RH-Map's pipeline (Fig. 2 of the paper) beside a tree, and what it keeps from scan to scan.
class RhMap::Removal {
 public:
  Removal(RhMap& tree, const RemovalConfig& config);

  const RemovalConfig& config() const { return config_; }
  bool isGround(const OcTreeKey& cube) const;
  std::size_t memoryUsage() const;

  ScanReport process(const octomap::Pointcloud& points, const octomap::pose6d& pose, bool insert);
  ScanReport finish();

 private:
  ScanContext contextOf(const octomap::pose6d& pose, const OcTreeKey& sensor, const RangeImage& image);
  void lookAgain(const ScanContext& keyframe, bool protect, ScanReport& report);
  void clearUp(std::span<const OcTreeKey> octants, int interval, const LookConfig& look, RemovalResult& result);
  std::size_t write(const octomap::Pointcloud& points, const octomap::pose6d& pose);
  void forgetFree(const OcTreeKey& corner, std::uint64_t cubes);
  void markFree(const octomap::Pointcloud& points, const octomap::pose6d& pose);
  void refreshAbove(const OcTreeKey& cube);
  void erase(const RemovalResult& result, ScanReport& report);
  void forgetFar(const OcTreeKey& sensor);

  RhMap& tree_;
  RemovalConfig config_;
  double resolution_;  // [m]
  RegionMap regions_;
  GroundEstimation ground_;
  FreeSpace free_space_;
  MovingHits moving_hits_;
  Keyframes keyframes_;
  std::optional<Projection> projection_;
  std::uint32_t scan_ = 0;
  // Of the scan at hand; kept for their memory.
  ScanPoints points_;
  ScanOctants octants_;
  ScanTrace trace_;
  std::vector<OcTreeKey> changed_;  // octants that have lost cubes, by their lowest
  ScanMasks cells_;
};

}  // namespace rhmap
