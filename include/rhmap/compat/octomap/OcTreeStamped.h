// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include <ctime>

#include "OcTreeNode.h"
#include "OccupancyOcTreeBase.h"
#include "rhmap/octree/stamped_octree.hpp"

namespace octomap {
using rhmap::OcTreeNodeStamped;
using rhmap::OcTreeStamped;
}  // namespace octomap
