// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include <octomap/ScanGraph.h>

#include "OcTreeNode.h"
#include "OccupancyOcTreeBase.h"
#include "rhmap/octree/octree.hpp"

namespace octomap {
using rhmap::OcTree;
}
