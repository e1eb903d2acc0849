// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "region_map.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {

/// The octants with occupied cells of a tree between (x, y) and (x + size, y + size), in keys, at any height. `x` and
/// `y` are multiples of `size`, a power of two of at least 4.
std::vector<CubesAt> readColumn(const OcTree& tree, key_type x, key_type y, int size);

}  // namespace rhmap
