// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include <octomap/ScanGraph.h>
#include <octomap/octomap_types.h>

#include <bitset>
#include <iterator>
#include <limits>
#include <list>
#include <stack>

#include "OcTreeKey.h"
#include "rhmap/octree/octree_base.hpp"

namespace octomap {
using rhmap::OcTreeBaseImpl;
}
