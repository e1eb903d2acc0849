// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/Pointcloud.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "rhmap/removal/rh_map.hpp"
#include "rhmap/sim/simulation.hpp"
#include "small_world.hpp"

namespace rhmap::test {

struct Scan {
  octomap::Pointcloud points;
  octomap::pose6d pose;
  std::vector<std::uint32_t> labels;
};

inline std::vector<Scan> simulate(const std::string& scene, std::size_t frames) {
  sim::SimulationConfig config;
  config.scene = scene;
  config.frames = frames;
  config.lidar.azimuth_step = 0.4;
  const sim::Simulation simulation(config);
  std::vector<Scan> scans;
  for (std::size_t k = 0; k < frames; ++k) {
    const sim::LidarScan scan = simulation.scan(k);
    const Eigen::Isometry3d pose = simulation.toldPose(k);
    const Eigen::Quaterniond q(pose.rotation());
    const Eigen::Vector3d t = pose.translation();
    Scan& to = scans.emplace_back();
    for (const auto& p : scan.points) to.points.push_back(p[0], p[1], p[2]);
    to.pose = octomap::pose6d(octomath::Vector3(float(t.x()), float(t.y()), float(t.z())),
                              octomath::Quaternion(float(q.w()), float(q.x()), float(q.y()), float(q.z())));
    to.labels = scan.labels;
  }
  return scans;
}

inline const std::vector<Scan>& street() {
  static const std::vector<Scan> scans = simulate("street", 30);
  return scans;
}

inline bool isOccupied(const OcTree& tree, const OcTreeKey& cube) {
  const OcTreeNode* node = tree.search(cube);
  return node != nullptr && tree.isNodeOccupied(node);
}

inline std::string bytes(const OcTree& tree) {
  std::stringstream out;
  tree.write(out);
  return out.str();
}

inline std::set<std::array<int, 3>> hitCubes(const OcTree& tree, const Scan& scan, double min_range) {
  std::set<std::array<int, 3>> cubes;
  octomap::Pointcloud world(scan.points);
  world.transform(scan.pose);
  for (unsigned i = 0; i < world.size(); ++i) {
    OcTreeKey key;
    const octomap::point3d& p = scan.points[i];
    const float range = std::sqrt(p.x() * p.x() + p.y() * p.y() + p.z() * p.z());
    if (range >= static_cast<float>(min_range) && tree.coordToKeyChecked(world[i], key))
      cubes.insert({key[0], key[1], key[2]});
  }
  return cubes;
}

inline OcTreeKey keyOf(const std::array<int, 3>& c) {
  return {static_cast<key_type>(c[0]), static_cast<key_type>(c[1]), static_cast<key_type>(c[2])};
}

inline void insertAll(RhMap& map, const std::vector<Scan>& scans) {
  for (const Scan& scan : scans) map.insertScan(scan.points, scan.pose);
  map.finish();
}

/// Shares of the static cubes that are kept and of the dynamic ones that are gone.
inline std::pair<double, double> score(const RhMap& map, const std::vector<Scan>& scans) {
  std::map<std::array<int, 3>, int> balance;
  for (const Scan& scan : scans) {
    octomap::Pointcloud world(scan.points);
    world.transform(scan.pose);
    for (unsigned i = 0; i < world.size(); ++i) {
      OcTreeKey key;
      if (scan.points[i].norm() < 2.7 || !map.coordToKeyChecked(world[i], key)) continue;
      balance[{key[0], key[1], key[2]}] += sim::isMoving(scan.labels[i]) ? 1 : -1;
    }
  }
  double kept = 0, still = 0, gone = 0, moving = 0;
  for (const auto& [cube, difference] : balance) {
    const bool occupied = isOccupied(map, keyOf(cube));
    (difference > 0 ? moving : still) += 1;
    if (difference > 0) gone += !occupied;
    if (difference <= 0) kept += occupied;
  }
  return {kept / still, moving > 0 ? gone / moving : 1};
}

/// A yard of level ground and a wall 20 m ahead that a box of 2 x 2 x 1.3 m crosses, 0.2 m above the ground and 8 to 10
/// m from the sensor: each ray by hand.
inline std::vector<Scan> yard(std::size_t frames, bool box) {
  std::vector<Scan> scans(frames);
  for (std::size_t k = 0; k < frames; ++k) {
    scans[k].points = wallAndGround(20, 64, 400);
    const float y0 = -8 + 0.5F * static_cast<float>(k);
    for (octomap::point3d& p : scans[k].points) {
      // Where the way from the sensor (0) to the point (1) enters and leaves the box.
      float in = 0, out = 1;
      const float low[] = {8, y0, -1.5F}, high[] = {10, y0 + 2, -0.2F};
      for (unsigned i = 0; i < 3; ++i) {
        const float a = low[i] / p(i), b = high[i] / p(i);
        in = std::max(in, std::min(a, b)), out = std::min(out, std::max(a, b));
      }
      const bool hit = box && in < out && in > 0;
      if (hit) p *= in;
      scans[k].labels.push_back(hit ? sim::kMovingCar : sim::kBuilding);
    }
  }
  return scans;
}

}  // namespace rhmap::test
