// SPDX-License-Identifier: BSD-3-Clause
#include "octomap_rows.hpp"

#include "ground_cells.hpp"
#include "mapping.hpp"
#include "progress_bar.hpp"
#include "rhmap/removal/rh_map.hpp"

namespace rhmap::tools {

OctomapBaseline runOctomapBaseline(const io::ScanSequence& sequence, const eval::SequenceWindow& window,
                                   double resolution) {
  OctomapBaseline baseline{std::make_unique<OcTree>(resolution), {}};
  RemovalConfig config = fastProfile();  // for its ground
  config.min_range = window.min_range;
  config.max_range = window.max_range.value_or(-1);
  RhMap ground_map(resolution, config);
  const std::size_t last = window.last.value_or(sequence.size() - 1);
  ProgressBar bar("octomap", last - window.first + 1);
  for (std::size_t i = window.first; i <= last; ++i) {
    const io::Scan scan = sequence.scan(i);
    baseline.map->insertPointCloud(worldPoints(scan, window.min_range, window.max_range), scan.pose.trans());
    ground_map.insertScan(scan.points, scan.pose);
    addGround(scan, ground_map, baseline.ground);
    bar.advance();
  }
  return baseline;
}

std::vector<eval::Estimate> octomapRows(const OcTree& map, const KeySet& ground) {
  const auto occupied = [&map](const octomap::point3d& point) {
    const OcTreeNode* node = map.search(point);
    return node != nullptr && map.isNodeOccupied(node);
  };
  const auto occupied_or_ground = [&map, &ground, occupied](const octomap::point3d& point) {
    OcTreeKey key;
    return occupied(point) || (map.coordToKeyChecked(point, key) && ground.contains(key));
  };
  return {eval::keptBy("octomap", occupied), eval::keptBy("octomap, ground kept", occupied_or_ground)};
}

}  // namespace rhmap::tools
