// SPDX-License-Identifier: BSD-3-Clause
// consumer MAP.bt: maps a wall, looks it up, writes it and reads it back.
#include <rhmap/octree/octree.hpp>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  octomap::Pointcloud wall;
  for (int i = -10; i <= 10; ++i) {
    for (int k = -10; k <= 10; ++k) wall.push_back(3, 0.1F * static_cast<float>(i), 0.1F * static_cast<float>(k));
  }
  rhmap::OcTree map(0.1);
  map.insertPointCloud(wall, octomap::point3d(0, 0, 0));

  const auto* hit = map.search(3, 0, 0);
  const auto* passed = map.search(1, 0, 0);
  if (hit == nullptr || !map.isNodeOccupied(hit)) return 1;
  if (passed == nullptr || map.isNodeOccupied(passed)) return 1;
  if (!map.writeBinary(argv[1])) return 1;

  rhmap::OcTree copy(0.1);
  return copy.readBinary(argv[1]) && copy.size() == map.size() ? 0 : 1;
}
