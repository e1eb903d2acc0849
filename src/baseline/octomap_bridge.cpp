// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/baseline/octomap_bridge.hpp"

#include <stdexcept>

namespace rhmap {
namespace {

/// A map that is filled from the inside.
class FilledMap : public OcTree {
 public:
  explicit FilledMap(const octomap::OcTree& tree) : OcTree(tree.getResolution()) {
    if (const octomap::OcTreeNode* root = tree.getRoot()) fill(tree, root, store_->createRoot());
  }

 private:
  void fill(const octomap::OcTree& tree, const octomap::OcTreeNode* from, NodeRef to) {
    store_->node(to)->setLogOdds(from->getLogOdds());
    unsigned mask = 0;
    for (unsigned i = 0; i < 8; ++i) mask |= unsigned{tree.nodeChildExists(from, i)} << i;
    if (mask == 0) return;
    if (to.depth() == kTreeDepth) throw std::invalid_argument("fromOctomap: a node at depth 16 has children");
    const NodeRef octet = store_->createChildren(to, static_cast<std::uint8_t>(mask));
    for (unsigned i = 0; i < 8; ++i)
      if (mask >> i & 1) fill(tree, tree.getNodeChild(from, i), {octet.block, octet.slot * 8 + static_cast<int>(i)});
  }
};

/// The map's protected members, as pointers to members: a subclass may name them, and they fit any object.
struct MapMembers : OcTree {
  static auto clampMin() { return &MapMembers::clamping_thres_min; }
  static auto clampMax() { return &MapMembers::clamping_thres_max; }
  static auto hit() { return &MapMembers::prob_hit_log; }
  static auto miss() { return &MapMembers::prob_miss_log; }
  static auto threshold() { return &MapMembers::occ_prob_thres_log; }
};

}  // namespace

OcTree fromOctomap(const octomap::OcTree& tree) {
  OcTree map(tree.getResolution());
  map.*MapMembers::clampMin() = tree.getClampingThresMinLog();
  map.*MapMembers::clampMax() = tree.getClampingThresMaxLog();
  map.*MapMembers::hit() = tree.getProbHitLog();
  map.*MapMembers::miss() = tree.getProbMissLog();
  map.*MapMembers::threshold() = tree.getOccupancyThresLog();
  FilledMap filled(tree);
  map.swapContent(filled);
  return map;
}

}  // namespace rhmap
