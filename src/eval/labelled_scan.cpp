// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/eval/labelled_scan.hpp"

#include <stdexcept>

namespace rhmap::eval {

LabelledScan labelledScan(const io::Scan& scan, const SequenceWindow& window) {
  octomap::Pointcloud world(scan.points);
  world.transform(scan.pose);
  LabelledScan result;
  for (std::size_t k = 0; k < scan.points.size(); ++k) {
    const double range = scan.points[k].norm();
    if (range < window.min_range || (window.max_range && range > *window.max_range)) continue;
    result.points.push_back(world[k]);
    result.in_sensor.push_back(scan.points[k]);
    result.labels.push_back(scan.labels[k]);
  }
  return result;
}

LabelledScan readLabelledScan(const io::ScanSequence& sequence, std::size_t i, const SequenceWindow& window) {
  const io::Scan scan = sequence.scan(i);
  if (scan.labels.size() != scan.points.size())
    throw std::runtime_error("scan " + sequence.name(i) + " has no labels; nothing can be scored against it");
  return labelledScan(scan, window);
}

}  // namespace rhmap::eval
