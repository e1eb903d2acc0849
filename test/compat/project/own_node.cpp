// SPDX-License-Identifier: BSD-3-Clause
// A tree of the user's own nodes, registered under its own name, as semantic and time-aware maps do it.
#include <octomap/OcTreeNode.h>
#include <octomap/OccupancyOcTreeBase.h>

#include <cstdio>
#include <memory>

#include "dice.hpp"
#include "parts.hpp"

namespace {

/// Carries a class besides its occupancy: the highest of its children's.
class LabelNode : public octomap::OcTreeNode {
 public:
  LabelNode() : octomap::OcTreeNode(), label(0) {}
  LabelNode(const LabelNode& other) : octomap::OcTreeNode(other), label(other.label) {}

  bool operator==(const LabelNode& other) const { return other.value == value && other.label == label; }
  void copyData(const LabelNode& from) {
    octomap::OcTreeNode::copyData(from);
    label = from.getLabel();
  }

  unsigned getLabel() const { return label; }
  void setLabel(unsigned l) { label = l; }

  void updateOccupancyChildren() {
    setLogOdds(getMaxChildLogOdds());
    label = 0;
    for (unsigned i = 0; i < 8; ++i) {
      const LabelNode* child = children == NULL ? NULL : static_cast<const LabelNode*>(children[i]);
      if (child != NULL && child->label > label) label = child->label;
    }
  }

  std::istream& readData(std::istream& s) {
    s.read(reinterpret_cast<char*>(&value), sizeof(value));
    return s.read(reinterpret_cast<char*>(&label), sizeof(label));
  }
  std::ostream& writeData(std::ostream& s) const {
    s.write(reinterpret_cast<const char*>(&value), sizeof(value));
    return s.write(reinterpret_cast<const char*>(&label), sizeof(label));
  }

 protected:
  unsigned label;
};

class LabelTree : public octomap::OccupancyOcTreeBase<LabelNode> {
 public:
  LabelTree(double resolution) : octomap::OccupancyOcTreeBase<LabelNode>(resolution) { initializer.ensureLinking(); }

  LabelTree* create() const { return new LabelTree(this->getResolution()); }
  std::string getTreeType() const { return "LabelTree"; }

  /// Occupied cells only melt into occupied nodes of one class.
  bool isNodeCollapsible(const LabelNode* node) const {
    if (!nodeChildExists(node, 0)) return false;
    const LabelNode* first = getNodeChild(node, 0);
    if (nodeHasChildren(first)) return false;
    for (unsigned i = 1; i < 8; i++) {
      if (!nodeChildExists(node, i) || nodeHasChildren(getNodeChild(node, i)) || !(*getNodeChild(node, i) == *first))
        return false;
    }
    return true;
  }

  LabelNode* updateLabel(const octomap::point3d& p, bool occupied, unsigned label) {
    LabelNode* node = updateNode(p, occupied, true);
    if (node != NULL && label > node->getLabel()) node->setLabel(label);
    return node;
  }

 protected:
  class StaticMemberInitializer {
   public:
    StaticMemberInitializer() {
      LabelTree* tree = new LabelTree(0.1);
      tree->clearKeyRays();
      octomap::AbstractOcTree::registerTreeType(tree);
    }
    void ensureLinking() {}
  };
  static StaticMemberInitializer initializer;
};

LabelTree::StaticMemberInitializer LabelTree::initializer;

}  // namespace

void ownNode(const std::string& folder) {
  LabelTree tree(0.1);
  Dice dice(9);
  for (int i = 0; i < 20000; ++i) {
    const octomap::point3d p = dice.point(0.6F);
    tree.updateLabel(p, dice.below(6) != 0, p.x() > 0 ? 3 : 5);
  }
  tree.updateInnerOccupancy();
  tree.prune();
  std::printf("own nodes: %zu, the root's class is %u\n", tree.size(), tree.getRoot()->getLabel());
  const octomap::point3d origin(0.2F, 0, 0);
  tree.insertPointCloud(roomScan(origin, 1000, dice), origin, 3.0);
  tree.write(folder + "/labels.ot");
  const std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(folder + "/labels.ot"));
  LabelTree* copy = dynamic_cast<LabelTree*>(any.get());
  std::printf("own nodes read: %d\n", copy != NULL && *copy == tree);
  tree.writeBinaryConst(folder + "/labels.bt");
}
