// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include <octomap/octomap_types.h>
#include <octomap/octomap_utils.h>

#include <limits>

#include "OcTreeDataNode.h"
#include "rhmap/octree/node.hpp"

namespace octomap {
using rhmap::OcTreeNode;
}
