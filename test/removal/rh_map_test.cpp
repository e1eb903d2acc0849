// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/removal/rh_map.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "rhmap/sim/simulation.hpp"

namespace rhmap {
namespace {

struct Scan {
  octomap::Pointcloud points;
  octomap::pose6d pose;
  std::vector<std::uint32_t> labels;
};

std::vector<Scan> simulate(const std::string& scene, std::size_t frames) {
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

const std::vector<Scan>& street() {
  static const std::vector<Scan> scans = simulate("street", 30);
  return scans;
}

bool isOccupied(const OcTree& tree, const OcTreeKey& cube) {
  const OcTreeNode* node = tree.search(cube);
  return node != nullptr && tree.isNodeOccupied(node);
}

std::string bytes(const OcTree& tree) {
  std::stringstream out;
  tree.write(out);
  return out.str();
}

std::set<std::array<int, 3>> hitCubes(const OcTree& tree, const Scan& scan, double min_range) {
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

OcTreeKey keyOf(const std::array<int, 3>& c) {
  return {static_cast<key_type>(c[0]), static_cast<key_type>(c[1]), static_cast<key_type>(c[2])};
}

void insertAll(RhMap& map, const std::vector<Scan>& scans) {
  for (const Scan& scan : scans) map.insertScan(scan.points, scan.pose);
  map.finish();
}

/// Shares of the static cubes that are kept and of the dynamic ones that are gone.
std::pair<double, double> score(const RhMap& map, const std::vector<Scan>& scans) {
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

TEST(RhMap, KeepsTheStreetAndLosesTheTraffic) {
  RhMap map(0.1);
  insertAll(map, street());
  const auto [kept, gone] = score(map, street());
  EXPECT_GT(kept, 0.99);
  EXPECT_GT(gone, 0.90);
}

TEST(RhMap, TakesNothingFromAWorldThatStands) {
  const std::vector<Scan> scans = simulate("static", 20);
  for (const std::string_view profile : {"fast", "default"}) {
    RhMap map(0.1, removalProfile(profile));
    insertAll(map, scans);
    EXPECT_GT(score(map, scans).first, 0.997) << profile;
  }
}

TEST(RhMap, WorksWithAllProfilesAndSizesOfRegions) {
  for (const std::string_view profile : removalProfiles()) {
    for (const int size : {4, 8, 16}) {
      RemovalConfig config = removalProfile(profile);
      config.region_size = size;
      RhMap map(0.1, config);
      std::size_t removed = 0;
      for (std::size_t k = 0; k < 14; ++k) removed += map.insertScan(street()[k].points, street()[k].pose).removed;
      removed += map.finish().removed;
      EXPECT_GT(removed, 50U) << profile << ' ' << size;
      EXPECT_GT(map.size(), 10000U);
    }
  }
}

TEST(RhMap, AfterEachScanItsHitsAreInTheMapButForThoseThatMove) {
  for (const std::string_view profile : {"fast", "default"}) {
    RhMap map(0.1, removalProfile(profile));
    for (std::size_t k = 0; k < 14; ++k) {
      const ScanReport report = map.insertScan(street()[k].points, street()[k].pose);
      std::size_t in_map = 0;
      const auto cubes = hitCubes(map, street()[k], map.config().min_range);
      for (const auto& cube : cubes) in_map += isOccupied(map, keyOf(cube));
      ASSERT_EQ(in_map, report.inserted) << profile << ' ' << k;
      ASSERT_EQ(report.inserted + report.rejected, cubes.size());
      ASSERT_EQ(report.points, street()[k].points.size());
    }
  }
}

TEST(RhMap, WithNothingToRemoveIsWhatUpdateNodeMakes) {
  RemovalConfig config = fastProfile();
  config.context.delta_1 = 0;
  config.back_end.enabled = false;
  RhMap map(0.1, config);
  OcTree plain(0.1);
  for (std::size_t k = 0; k < 8; ++k) {
    map.insertScan(street()[k].points, street()[k].pose);
    for (const auto& cube : hitCubes(plain, street()[k], config.min_range)) plain.updateNode(keyOf(cube), true);
  }
  EXPECT_EQ(bytes(map), bytes(plain));
}

TEST(RhMap, IsTheSameWithAnyNumberOfThreadsAndInEachRun) {
  RemovalConfig config;
  config.carve = true;
  std::vector<std::string> maps;
  for (const int threads : {1, 1, 3}) {
    RhMap map(0.2, config);
    map.setNumThreads(threads);
    for (std::size_t k = 0; k < 10; ++k) map.insertScan(street()[k].points, street()[k].pose);
    map.finish();
    maps.push_back(bytes(map));
  }
  EXPECT_EQ(maps[0], maps[1]);
  EXPECT_EQ(maps[0], maps[2]);
}

TEST(RhMap, CarvesFreeSpaceAndKeepsWhatIsOccupied) {
  RemovalConfig config;
  RhMap ends(0.2, config);
  config.carve = true;
  RhMap carved(0.2, config);
  for (std::size_t k = 0; k < 10; ++k) {
    ends.insertScan(street()[k].points, street()[k].pose);
    carved.insertScan(street()[k].points, street()[k].pose);
  }
  std::size_t occupied = 0, free = 0;
  for (auto it = ends.begin_leafs(), end = ends.end_leafs(); it != end; ++it) {
    if (it.getSize() > 0.3) continue;
    ++occupied;
    ASSERT_TRUE(isOccupied(carved, it.getKey()));
  }
  for (auto it = carved.begin_leafs(), end = carved.end_leafs(); it != end; ++it) free += !carved.isNodeOccupied(*it);
  EXPECT_GT(occupied, 3000U);
  EXPECT_GT(free, 10000U);
}

TEST(RhMap, MakesRemovedCubesFreeIfAsked) {
  RemovalConfig config = fastProfile();
  RhMap unknown(0.1, config);
  config.removed = RemovedCubes::kFree;
  RhMap free(0.1, config);
  insertAll(unknown, street());
  insertAll(free, street());
  const auto countFree = [](const OcTree& tree) {
    std::size_t count = 0;
    for (auto it = tree.begin_leafs(), end = tree.end_leafs(); it != end; ++it) count += !tree.isNodeOccupied(*it);
    return count;
  };
  EXPECT_EQ(countFree(unknown), 0U);
  EXPECT_GT(countFree(free), 100U);
}

TEST(RhMap, IsWrittenAndReadLikeAnyOther) {
  RhMap map(0.1);
  insertAll(map, std::vector<Scan>(street().begin(), street().begin() + 10));
  std::stringstream file;
  map.write(file);
  const std::unique_ptr<AbstractOcTree> read(AbstractOcTree::read(file));
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(bytes(dynamic_cast<OcTree&>(*read)), bytes(map));
}

TEST(RhMap, CleansAMapThatWasRead) {
  RhMap dirty(0.1, [] {
    RemovalConfig config = fastProfile();
    config.context.delta_1 = 0;
    config.back_end.enabled = false;
    return config;
  }());
  insertAll(dirty, street());
  std::stringstream file;
  dirty.writeBinary(file);
  RhMap map(0.1);
  ASSERT_TRUE(map.readBinary(file));
  const std::size_t before = map.getNumLeafNodes();
  std::size_t removed = 0;
  for (const Scan& scan : street()) {
    const ScanReport report = map.removeDynamic(scan.points, scan.pose);
    EXPECT_EQ(report.inserted, 0U);
    removed += report.removed;
  }
  EXPECT_GT(removed, 1000U);
  EXPECT_LT(map.getNumLeafNodes(), before + 8 * removed);
  const auto [kept, gone] = score(map, street());
  EXPECT_GT(kept, 0.98);
  EXPECT_GT(gone, 0.4);
}

TEST(RhMap, SurvivesBadScans) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  octomap::Pointcloud bad;
  for (const float v : {kNan, kInf, -kInf, 1e30F, -1e30F, 0.0F}) bad.push_back(v, 10, 1);
  RhMap map(0.1);
  const ScanReport report = map.insertScan(bad, octomap::pose6d());
  EXPECT_EQ(report.points, 6U);
  EXPECT_EQ(report.dropped, 5U);
  map.insertScan(octomap::Pointcloud(), octomap::pose6d());
  map.insertScan(street()[0].points, octomap::pose6d(1e9F, 0, 0, 0, 0, 0));
  map.insertScan(street()[0].points, octomap::pose6d(kNan, 0, 0, 0, 0, 0));
  map.insertScan(street()[0].points, octomap::pose6d(3270, 3270, 0, 0, 0, 0));  // at the border of the keys
  map.removeDynamic(bad, octomap::pose6d());
  EXPECT_GT(map.insertScan(street()[0].points, street()[0].pose).inserted, 1000U);
  map.finish();
}

TEST(RhMap, FollowsChangesWithChangeDetection) {
  RhMap map(0.1);
  map.enableChangeDetection(true);
  const ScanReport report = map.insertScan(street()[0].points, street()[0].pose);
  EXPECT_EQ(map.numChangesDetected(), report.inserted);
}

TEST(RhMap, HasGroundUnderTheCarrier) {
  RhMap map(0.1);
  for (std::size_t k = 0; k < 4; ++k) map.insertScan(street()[k].points, street()[k].pose);
  std::size_t road = 0, ground = 0;
  octomap::Pointcloud world(street()[3].points);
  world.transform(street()[3].pose);
  for (unsigned i = 0; i < world.size(); ++i) {
    if ((street()[3].labels[i] & 0xffffU) != sim::kRoad || street()[3].points[i].norm() > 15 ||
        street()[3].points[i].norm() < 3)
      continue;
    OcTreeKey key;
    ASSERT_TRUE(map.coordToKeyChecked(world[i], key));
    ++road;
    ground += map.isGround(key);
  }
  EXPECT_GT(road, 1000U);
  EXPECT_GT(static_cast<double>(ground), 0.97 * static_cast<double>(road));
}

TEST(RhMap, ACopyGoesItsOwnWay) {
  RhMap map(0.1);
  map.insertScan(street()[0].points, street()[0].pose);
  RhMap copy(map);
  const std::string before = bytes(copy);
  map.insertScan(street()[1].points, street()[1].pose);
  EXPECT_EQ(bytes(copy), before);
  copy.insertScan(street()[1].points, street()[1].pose);
  EXPECT_GT(copy.size(), 0U);
}

TEST(RhMap, RefusesAWrongConfiguration) {
  RemovalConfig config;
  config.region_size = 7;
  EXPECT_THROW(RhMap(0.1, config), std::invalid_argument);
}

}  // namespace
}  // namespace rhmap
