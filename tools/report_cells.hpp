// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string>

#include "rhmap/core/key_set.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap::tools {

/// A map for the page's 3D view.
struct NamedMap {
  std::string name;
  const OcTree* map = nullptr;
};

/// The occupied cells of maps of one resolution as the JSON that tools/report/viewer.js reads; those of `moving` are
/// marked. Keys count from the smallest one of all maps.
std::string cellsJson(std::span<const NamedMap> maps, const KeySet& moving);

}  // namespace rhmap::tools
