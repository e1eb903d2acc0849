// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include <iostream>

#include "OcTreeNode.h"
#include "OccupancyOcTreeBase.h"
#include "rhmap/octree/color_octree.hpp"

namespace octomap {
using rhmap::ColorOcTree;
using rhmap::ColorOcTreeNode;
}  // namespace octomap
