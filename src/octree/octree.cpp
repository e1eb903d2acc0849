// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/octree.hpp"

namespace rhmap {

template class OcTreeBaseImpl<OcTreeNode, AbstractOccupancyOcTree>;
template class OccupancyOcTreeBase<OcTreeNode>;

}  // namespace rhmap
