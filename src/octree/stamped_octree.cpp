// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/stamped_octree.hpp"

namespace rhmap {

template class OcTreeBaseImpl<OcTreeNodeStamped, AbstractOccupancyOcTree>;
template class OccupancyOcTreeBase<OcTreeNodeStamped>;

void OcTreeStamped::degradeOutdatedNodes(unsigned time_thres) {
  const auto now = static_cast<unsigned>(std::time(nullptr));
  for (auto it = begin_leafs(), last = end_leafs(); it != last; ++it)
    if (isNodeOccupied(*it) && now - it->getTimestamp() > time_thres) integrateMissNoTime(&*it);
}

void OcTreeStamped::updateNodeLogOdds(OcTreeNodeStamped* node, const float& update) const {
  OccupancyOcTreeBase::updateNodeLogOdds(node, update);
  node->updateTimestamp();
}

void OcTreeStamped::integrateMissNoTime(OcTreeNodeStamped* node) const {
  OccupancyOcTreeBase::updateNodeLogOdds(node, prob_miss_log);
}

}  // namespace rhmap
