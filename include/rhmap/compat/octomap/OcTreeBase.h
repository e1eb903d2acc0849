// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include "AbstractOcTree.h"
#include "OcTreeBaseImpl.h"
#include "rhmap/octree/octree_base.hpp"

namespace octomap {
using rhmap::OcTreeBase;
}
