// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include <octomap/octomap_types.h>
#include <octomap/octomap_utils.h>

#include <stdlib.h>
#include <algorithm>
#include <bitset>
#include <list>
#include <vector>

#include "AbstractOccupancyOcTree.h"
#include "OcTreeBaseImpl.h"
#include "rhmap/octree/occupancy_octree_base.hpp"

namespace octomap {
using rhmap::OccupancyOcTreeBase;
}
