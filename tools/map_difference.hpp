// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "rhmap/octree/octree.hpp"

namespace rhmap::tools {

/// How two maps differ, in cells of the finest size, however they are pruned.
struct MapDifference {
  std::uint64_t known = 0;   ///< cells that at least one of them knows
  std::uint64_t states = 0;  ///< of these: unknown, free or occupied in one and something else in the other
  std::uint64_t values = 0;  ///< other log-odds, or unknown in one of them
};

/// Compares all cells. Keys are compared as they are: give it maps of the same resolution.
MapDifference differenceOf(const OcTree& a, const OcTree& b);

}  // namespace rhmap::tools
