// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include <stdio.h>

#include "OcTreeBase.h"
#include "OcTreeDataNode.h"
#include "rhmap/octree/counting_octree.hpp"

namespace octomap {
using rhmap::CountingOcTree;
using rhmap::CountingOcTreeNode;
}  // namespace octomap
