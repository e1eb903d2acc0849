// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include <string>

#include "OcTree.h"
#include "rhmap/octree/map_node.hpp"

namespace octomap {
using rhmap::MapNode;
}
