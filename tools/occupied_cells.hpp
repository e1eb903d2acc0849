// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <octomap/octomap_types.h>

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "rhmap/core/key.hpp"

namespace rhmap::tools {

/// What a map can become: a map, or the cloud of its occupied cells.
inline constexpr std::array<std::string_view, 4> kMapAndCloudExtensions{".bt", ".ot", ".ply", ".pcd"};

/// Whether an extension of these means a cloud.
inline bool isCloud(std::string_view extension) { return extension == ".ply" || extension == ".pcd"; }

/// Writes points [m] as the extension says, .ply or .pcd.
void writeCloud(const std::string& path, std::span<const octomap::point3d> points);

/// 12 GB of points; more is a mistake rather than a wish.
inline constexpr std::uint64_t kMaxCloudCells = 1'000'000'000;

/// Bits 0, 3, 6, ... of a number, packed: one axis of a Morton index.
inline unsigned everyThirdBit(std::uint64_t index) {
  unsigned bits = 0;
  for (unsigned i = 0; i < kTreeDepth; ++i) bits |= static_cast<unsigned>(index >> (3 * i) & 1U) << i;
  return bits;
}

inline std::uint64_t numCells(unsigned depth) { return std::uint64_t{1} << (3 * (kTreeDepth - depth)); }

/// Centres [m] of the occupied cells, larger leaves cut into the smallest cubes in the order of expanded leaves. `path`
/// is for the message of a map that is too large.
template <class TREE>
std::vector<octomap::point3d> occupiedCells(const std::string& path, const TREE& tree) {
  std::uint64_t count = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (tree.isNodeOccupied(*leaf)) count += numCells(leaf.getDepth());
    if (count > kMaxCloudCells)
      throw std::runtime_error(
          fmt::format("{}: more than {} occupied cells, too many for a cloud", path, kMaxCloudCells));
  }
  std::vector<octomap::point3d> points;
  points.reserve(count);
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const octomap::OcTreeKey corner = leaf.getIndexKey();
    for (std::uint64_t i = 0; i < numCells(leaf.getDepth()); ++i) {
      octomap::OcTreeKey key = corner;
      for (unsigned axis = 0; axis < 3; ++axis)
        key[axis] = static_cast<octomap::key_type>(key[axis] + everyThirdBit(i >> axis));
      points.push_back(tree.keyToCoord(key));
    }
  }
  return points;
}

}  // namespace rhmap::tools
