// SPDX-License-Identifier: BSD-3-Clause
#include "ground_cells.hpp"

#include "removal_run.hpp"

namespace rhmap::tools {

void addGround(const io::Scan& scan, const RhMap& map, KeySet& ground) {
  OcTreeKey key;
  for (const octomap::point3d& point : scan.points)
    if (map.coordToKeyChecked(scan.pose.transform(point), key) && map.isGround(key)) ground.insert(key);
}

KeySet groundCells(const io::ScanSequence& sequence, const FrameRange& frames, double resolution) {
  RhMap map(resolution, fastProfile());  // all profiles have the same ground but `paper`
  KeySet ground;
  runRemoval(sequence, frames, map, "ground",
             [&](const io::Scan& scan, const RhMap& now) { addGround(scan, now, ground); });
  return ground;
}

}  // namespace rhmap::tools
