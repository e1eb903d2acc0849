// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../../src/baseline/quiet_octomap.hpp"  // first: it silences OctoMap's templates

#include <octomap/OcTree.h>

#include <filesystem>
#include <memory>

#include "rhmap/baseline/octomap_mirror.hpp"
#include "rhmap/io/scan_sequence.hpp"

namespace rhmap::test {

/// A street that is mapped twice by the same calls: by stock OctoMap, and by rhmap with a mirror for OctoMap's
/// consumers.
struct Street {
  explicit Street(const std::filesystem::path& sequence) : scans(io::openSequence(sequence)) {}

  void insertScan(std::size_t i) {
    io::Scan scan = scans->scan(i);
    scan.points.transform(scan.pose);
    map.insertPointCloud(scan.points, scan.pose.trans(), kMaxRange);
    stock->insertPointCloud(scan.points, scan.pose.trans(), kMaxRange);
  }

  static constexpr double kResolution = 0.2;  // [m]
  static constexpr double kMaxRange = 25;     // [m]

  std::unique_ptr<io::ScanSequence> scans;
  OcTree map{kResolution};
  std::shared_ptr<OctomapMirror> mirror = std::make_shared<OctomapMirror>(map);
  std::shared_ptr<octomap::OcTree> stock = std::make_shared<octomap::OcTree>(kResolution);
};

}  // namespace rhmap::test
