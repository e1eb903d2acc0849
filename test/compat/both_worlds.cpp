// SPDX-License-Identifier: BSD-3-Clause
// Must not compile: OctoMap's own tree, found by a path of its own, and ours in one file.
#include STOCK_OCTREE

#include <octomap/ColorOcTree.h>
