// SPDX-License-Identifier: BSD-3-Clause
// What octomap_server does with a scan: its own sets of keys, its own bounds, a 2D map, a cleared box.
#include <octomap/octomap.h>

#include <octomap/OcTreeKey.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "dice.hpp"
#include "parts.hpp"

namespace {

void widen(octomap::OcTreeKey& min, octomap::OcTreeKey& max, const octomap::OcTreeKey& key) {
  for (unsigned i = 0; i < 3; ++i) {
    min[i] = std::min(min[i], key[i]);
    max[i] = std::max(max[i], key[i]);
  }
}

void insertScan(octomap::OcTree* tree, const octomap::point3d& sensor, const octomap::Pointcloud& scan, double range) {
  octomap::OcTreeKey min, max;
  if (!tree->coordToKeyChecked(sensor, min) || !tree->coordToKeyChecked(sensor, max)) {
    OCTOMAP_ERROR_STR("Could not generate Key for origin " << sensor);
    return;
  }
  octomap::KeyRay ray;
  octomap::KeySet free_cells, occupied_cells;
  for (octomap::Pointcloud::const_iterator it = scan.begin(); it != scan.end(); ++it) {
    octomap::point3d point(*it);
    if (range < 0.0 || (point - sensor).norm() <= range) {
      if (tree->computeRayKeys(sensor, point, ray)) free_cells.insert(ray.begin(), ray.end());
      octomap::OcTreeKey key;
      if (tree->coordToKeyChecked(point, key)) {
        occupied_cells.insert(key);
        widen(min, max, key);
      }
    } else {
      octomap::point3d end = sensor + (point - sensor).normalized() * static_cast<float>(range);
      if (tree->computeRayKeys(sensor, end, ray)) free_cells.insert(ray.begin(), ray.end());
    }
  }
  for (octomap::KeySet::iterator it = free_cells.begin(), end = free_cells.end(); it != end; ++it) {
    if (occupied_cells.find(*it) == occupied_cells.end()) tree->updateNode(*it, false);
  }
  for (octomap::KeySet::iterator it = occupied_cells.begin(), end = occupied_cells.end(); it != end; it++) {
    tree->updateNode(*it, true);
  }
  std::printf("scan: %zu free, %zu occupied, keys %u %u %u ... %u %u %u\n", free_cells.size(), occupied_cells.size(),
              min[0], min[1], min[2], max[0], max[1], max[2]);
}

/// The occupied columns of the map at a depth, as rows of text.
void project(const octomap::OcTree& tree, unsigned depth) {
  double min_x, min_y, min_z, max_x, max_y, max_z;
  tree.getMetricMin(min_x, min_y, min_z);
  tree.getMetricMax(max_x, max_y, max_z);
  const octomap::OcTreeKey corner = tree.coordToKey(octomap::point3d(float(min_x), float(min_y), float(min_z)), depth);
  const octomap::OcTreeKey far = tree.coordToKey(max_x, max_y, max_z, depth);
  const unsigned shift = tree.getTreeDepth() - depth;
  const unsigned width = ((far[0] - corner[0]) >> shift) + 1, height = ((far[1] - corner[1]) >> shift) + 1;
  std::vector<char> cells(width * height, '?');
  for (octomap::OcTree::iterator it = tree.begin(depth), end = tree.end(); it != end; ++it) {
    const bool occupied = tree.isNodeOccupied(*it);
    const unsigned size = 1U << (depth - it.getDepth());
    const octomap::OcTreeKey low = it.getIndexKey();
    for (unsigned dx = 0; dx < size; ++dx) {
      for (unsigned dy = 0; dy < size; ++dy) {
        const unsigned x = ((low[0] - (corner[0] >> shift << shift)) >> shift) + dx;
        const unsigned y = ((low[1] - (corner[1] >> shift << shift)) >> shift) + dy;
        if (x >= width || y >= height) continue;
        char& cell = cells[y * width + x];
        if (occupied) {
          cell = '#';
        } else if (cell == '?') {
          cell = '.';
        }
      }
    }
  }
  for (unsigned y = 0; y < height; ++y) std::printf("%.*s\n", static_cast<int>(width), &cells[y * width]);
}

/// Frees a box through the iterator, as the service clear_bbx does.
void clearBox(octomap::OcTree& tree, const octomap::point3d& min, const octomap::point3d& max) {
  const double threshold = tree.getClampingThresMin();
  unsigned cleared = 0;
  for (octomap::OcTree::leaf_bbx_iterator it = tree.begin_leafs_bbx(min, max), end = tree.end_leafs_bbx(); it != end;
       ++it, ++cleared) {
    it->setLogOdds(octomap::logodds(threshold));
  }
  tree.updateInnerOccupancy();
  std::printf("cleared %u leaves\n", cleared);
}

}  // namespace

void server(const std::string& folder) {
  octomap::OcTree* tree = new octomap::OcTree(0.1);
  tree->setProbHit(0.7);
  tree->setProbMiss(0.4);
  tree->setClampingThresMin(0.12);
  tree->setClampingThresMax(0.97);
  Dice dice(1);
  for (int i = 0; i < 8; ++i) {
    const octomap::point3d sensor(static_cast<float>(i) - 3.5F, dice.between(-2, 2), 0.2F);
    insertScan(tree, sensor, roomScan(sensor, 2000, dice), i % 2 == 0 ? -1.0 : 5.0);
  }
  std::printf("%zu nodes, %zu leaves, volume %.6f\n", tree->size(), tree->getNumLeafNodes(), tree->volume());
  project(*tree, tree->getTreeDepth());
  project(*tree, 14);
  clearBox(*tree, octomap::point3d(-1, -1, -1), octomap::point3d(2.04F, 1.5F, 1));
  tree->write(folder + "/server_cleared.ot");
  tree->prune();
  tree->write(folder + "/server_pruned.ot");
  tree->writeBinary(folder + "/server.bt");
  octomap::OcTree read_back(folder + "/server.bt");
  std::printf("%zu nodes read, as the map: %d\n", read_back.size(), *tree == read_back);
  delete tree;
}
