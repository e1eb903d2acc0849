// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include <stdio.h>
#include <fstream>
#include <sstream>
#include <vector>

#include "MapNode.h"
#include "rhmap/octree/map_collection.hpp"

namespace octomap {
using rhmap::MapCollection;
}
