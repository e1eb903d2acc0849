// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/counting_octree.hpp"

namespace rhmap {

CountingOcTreeNode* CountingOcTree::updateNode(const point3d& value) {
  OcTreeKey key;
  return coordToKeyChecked(value, key) ? updateNode(key) : nullptr;
}

CountingOcTreeNode* CountingOcTree::updateNode(const OcTreeKey& key) {
  NodeRef at = store_->empty() ? store_->createRoot() : store_->root();
  store_->node(at)->increaseCount();
  while (at.depth() < tree_depth) {
    const NodeRef child = structure::childTowards(*store_, at, key);
    at = child ? child : store_->createChild(at, structure::childNumber(at, key));
    store_->node(at)->increaseCount();
  }
  return store_->node(at);
}

void CountingOcTree::getCentersMinHits(point3d_list& node_centers, unsigned min_hits) const {
  for (auto it = begin_leafs(), last = end_leafs(); it != last; ++it)
    if (it->getCount() >= min_hits) node_centers.push_back(keyToCoord(it.getKey(), it.getDepth()));
}

}  // namespace rhmap
