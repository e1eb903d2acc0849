// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "region_map.hpp"
#include "rhmap/octree/node.hpp"

namespace rhmap {

/// The octants with occupied cells (of this log-odds or more) of a tree between (x, y) and (x + size, y + size), in
/// keys, at any height. `x` and `y` are multiples of `size`, a power of two of at least 4. From the tree's inside, as
/// each new column is looked for there, though most are new to it, too.
std::vector<CubesAt> readColumn(const BlockStore<OcTreeNode>& tree, float occupied_from, key_type x, key_type y,
                                int size);

}  // namespace rhmap
