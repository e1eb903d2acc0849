// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include <octomap/octomap_types.h>

#include <cassert>

#include "rhmap/octree/node.hpp"

namespace octomap {
using rhmap::AbstractOcTreeNode;
using rhmap::OcTreeDataNode;
}  // namespace octomap
