// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include <octomap/octomap_utils.h>

#include <cassert>
#include <fstream>

#include "AbstractOcTree.h"
#include "OcTreeKey.h"
#include "OcTreeNode.h"
#include "rhmap/octree/abstract_occupancy_octree.hpp"

namespace octomap {
using rhmap::AbstractOccupancyOcTree;
}
