// SPDX-License-Identifier: BSD-3-Clause
// Const calls from several threads at once; built with ThreadSanitizer, which fails the test on a data race.
#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <thread>
#include <vector>

#include "rhmap/octree/octree.hpp"

namespace rhmap {
namespace {

/// Everything that a reader may call, folded into one number.
double readAll(const OcTree& map) {
  double sum = 0;
  for (auto it = map.begin(), end = map.end(); it != end; ++it) sum += it.getX() + it->getLogOdds();
  for (auto it = map.begin_tree(12), end = map.end_tree(); it != end; ++it) sum += it.isLeaf() ? it->getOccupancy() : 0;
  for (auto it = map.begin_leafs_bbx(point3d(-1, -1, -1), point3d(1, 1, 1)), end = map.end_leafs_bbx(); it != end; ++it)
    sum += it.getSize();
  std::mt19937 random(1);
  std::uniform_real_distribution<float> coordinate(-3, 3);
  octomap::KeyRay ray;
  for (int i = 0; i < 500; ++i) {
    const point3d a(coordinate(random), coordinate(random), coordinate(random));
    const point3d b(coordinate(random), coordinate(random), coordinate(random));
    if (const OcTreeNode* node = map.search(a, 10 + i % 7)) sum += node->getLogOdds() + map.nodeHasChildren(node);
    point3d end;
    sum += map.castRay(a, b - a, end, i % 2 == 0, 4.0);
    sum += map.computeRayKeys(a, b, ray) ? static_cast<double>(ray.size()) : 0;
  }
  double x, y, z;
  map.getMetricMin(x, y, z);
  map.getMetricSize(x, y, z);
  std::ostringstream out;
  map.write(out);
  map.writeBinaryConst(out);
  sum += static_cast<double>(map.getNumLeafNodes() + map.memoryUsage() + out.str().size());
  const OcTree copy(map);
  return sum + x + (copy == map);
}

TEST(ConcurrentReads, OfOneMapRaceNowhereAndAgree) {
  OcTree map(0.1);
  octomap::Pointcloud scan;
  std::mt19937 random(2);
  std::uniform_real_distribution<float> coordinate(-3, 3);
  for (int i = 0; i < 500; ++i) scan.push_back(coordinate(random), coordinate(random), coordinate(random));
  map.insertPointCloud(scan, point3d(0, 0, 0));
  const double expected = readAll(map);
  std::vector<double> answers(4);
  std::vector<std::thread> readers;
  for (double& answer : answers) readers.emplace_back([&answer, &map] { answer = readAll(map); });
  for (std::thread& reader : readers) reader.join();
  for (const double answer : answers) EXPECT_EQ(answer, expected);
}

}  // namespace
}  // namespace rhmap
