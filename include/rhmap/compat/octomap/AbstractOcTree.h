// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "../only_rhmap.h"

#include <cstddef>
#include <fstream>
#include <iostream>
#include <map>
#include <string>

#include "rhmap/octree/abstract_octree.hpp"

namespace octomap {
using rhmap::AbstractOcTree;
}
