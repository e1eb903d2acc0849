// SPDX-License-Identifier: BSD-3-Clause
// The other trees: colour, counters, time stamps, collections of maps.
#include <octomap/ColorOcTree.h>
#include <octomap/CountingOcTree.h>
#include <octomap/MapCollection.h>
#include <octomap/OcTreeStamped.h>

#include <cstdio>
#include <memory>

#include "dice.hpp"
#include "parts.hpp"

namespace {

void colour(const std::string& folder) {
  octomap::ColorOcTree tree(0.1);
  Dice dice(6);
  for (int i = 0; i < 20000; ++i) {
    const octomap::point3d p = dice.point(0.8F);
    tree.updateNode(p, dice.below(4) != 0);
    const octomap::OcTreeKey key = tree.coordToKey(p);
    tree.averageNodeColor(key, uint8_t(dice.below(256)), uint8_t(key[0]), uint8_t(key[2]));
  }
  tree.updateInnerOccupancy();
  tree.write(folder + "/colour.ot");
  const std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(folder + "/colour.ot"));
  octomap::ColorOcTree* copy = dynamic_cast<octomap::ColorOcTree*>(any.get());
  const octomap::ColorOcTreeNode* node = copy->search(octomap::point3d(0.05F, 0.05F, 0.05F));
  std::printf("colour: %zu nodes, %u %u %u\n", copy->size(), node->getColor().r, node->getColor().g,
              node->getColor().b);
  tree.prune();
  tree.writeBinary(folder + "/colour.bt");
  std::printf("colour, pruned: %zu nodes, of type %s\n", tree.size(), tree.getTreeType().c_str());
}

void counting(const std::string& folder) {
  octomap::CountingOcTree tree(0.1);
  Dice dice(7);
  for (int i = 0; i < 5000; ++i) tree.updateNode(dice.point(0.6F));
  octomap::point3d_list often;
  tree.getCentersMinHits(often, 4);
  std::printf("counting: %zu nodes, %u at the root, %zu cells often\n", tree.size(), tree.getRoot()->getCount(),
              often.size());
  tree.write(folder + "/counting.ot");
}

void stamped() {
  octomap::OcTreeStamped tree(0.1);
  Dice dice(8);
  for (int i = 0; i < 3000; ++i) tree.updateNode(dice.point(1.0F), true, true);
  tree.updateInnerOccupancy();
  std::printf("stamped: %zu leaves, updated: %d\n", tree.getNumLeafNodes(), tree.getLastUpdateTime() != 0);
}

void collection(const std::string& folder) {
  typedef octomap::MapNode<octomap::OcTree> Node;
  octomap::MapCollection<Node> maps;
  for (int i = 0; i < 2; ++i) {
    octomap::OcTree* tree = new octomap::OcTree(0.1);
    for (int k = -10; k <= 10; ++k) {
      for (int m = -10; m <= 10; ++m) tree->updateNode(octomap::point3d(1.05F, 0.1F * float(k), 0.1F * float(m)), true);
    }
    Node* node = new Node(tree, octomap::pose6d(2.0F * float(i), 0, 0, 0, 0, 0));
    node->setId(i == 0 ? "first" : "second");
    maps.addNode(node);
  }
  std::printf("collection: %zu maps, %d %d\n", maps.size(), maps.isOccupied(octomap::point3d(1.05F, 0, 0)),
              maps.isOccupied(octomap::point3d(2.05F, 0, 0)));
  (*maps.begin())->writeMap(folder + "/node.bt");
}

}  // namespace

void trees(const std::string& folder) {
  colour(folder);
  counting(folder);
  stamped();
  collection(folder);
}
