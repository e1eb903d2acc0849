// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "clock.hpp"
#include "library.hpp"
#include "rhmap/core/key.hpp"

/// Ways for a scan to get into a map; over any tree and any set of keys with OctoMap's names.
namespace rhmap::bench::scans {

template <class Tree>
void insert(Tree& tree, const WorldScan& scan, double max_range) {
  tree.insertPointCloud(scan.points, scan.origin, max_range);
}

template <class Tree>
void insertDiscretized(Tree& tree, const WorldScan& scan, double max_range) {
  tree.insertPointCloud(scan.points, scan.origin, max_range, false, true);
}

template <class Tree>
void insertLazily(Tree& tree, const WorldScan& scan, double max_range) {
  tree.insertPointCloud(scan.points, scan.origin, max_range, true);
  tree.updateInnerOccupancy();
}

template <class Tree>
void insertWithChanges(Tree& tree, const WorldScan& scan, double max_range) {
  tree.enableChangeDetection(true);
  tree.insertPointCloud(scan.points, scan.origin, max_range);
  tree.resetChangeDetection();
}

/// The loop of octomap_server's insertScan().
template <class Tree, class KeySet>
void insertLikeOctomapServer(Tree& tree, const WorldScan& scan, double max_range) {
  KeySet free_cells;
  KeySet occupied_cells;
  octomap::KeyRay ray;
  for (octomap::point3d point : scan.points) {
    const bool in_range = max_range < 0 || (point - scan.origin).norm() <= max_range;
    if (!in_range) point = scan.origin + (point - scan.origin).normalized() * static_cast<float>(max_range);
    if (tree.computeRayKeys(scan.origin, point, ray)) free_cells.insert(ray.begin(), ray.end());
    octomap::OcTreeKey key;
    if (in_range && tree.coordToKeyChecked(point, key)) occupied_cells.insert(key);
  }
  for (const octomap::OcTreeKey& key : free_cells)
    if (occupied_cells.find(key) == occupied_cells.end()) tree.updateNode(key, false);
  for (const octomap::OcTreeKey& key : occupied_cells) tree.updateNode(key, true);
}

inline constexpr std::array kTitles{
    Title{"insertPointCloud", "scan"},
    Title{"insertPointCloud, discretize", "scan"},
    Title{"insertPointCloud, lazy_eval, and updateInnerOccupancy", "scan"},
    Title{"insertPointCloud, change detection", "scan"},
    Title{"octomap_server: computeRayKeys, KeySet, updateNode", "scan"},
};

template <class Tree, class KeySet>
inline constexpr std::array<void (*)(Tree&, const WorldScan&, double), kTitles.size()> kFunctions{
    insert<Tree>, insertDiscretized<Tree>, insertLazily<Tree>, insertWithChanges<Tree>,
    insertLikeOctomapServer<Tree, KeySet>};

}  // namespace rhmap::bench::scans
