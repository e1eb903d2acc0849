// SPDX-License-Identifier: BSD-3-Clause
// A node class and a tree class as users of OctoMap write them, with every habit that their code has: the names
// `children`, `root`, `tree_size`, giving up a child array by hand, streams for the payload, own rules of pruning and
// of inner values. Included once for each world; OCTO is the namespace that it derives from. No include guard on
// purpose.

class HeatNode : public OCTO::OcTreeNode {
 public:
  friend class HeatTree;  // needs access to node children (inherited)

  HeatNode() : OcTreeNode(), heat(0) {}
  HeatNode(const HeatNode& rhs) : OcTreeNode(rhs), heat(rhs.heat), visits(rhs.visits) {}

  bool operator==(const HeatNode& rhs) const { return rhs.value == value && rhs.heat == heat; }

  void copyData(const HeatNode& from) {
    OcTreeNode::copyData(from);
    heat = from.heat;
    visits = from.visits;
  }

  unsigned getHeat() const { return heat; }
  void addHeat(unsigned h) {
    heat += h;
    visits.push_back(h);
  }

  unsigned getAverageChildHeat() const {
    unsigned sum = 0;
    unsigned count = 0;
    if (children != NULL) {
      for (int i = 0; i < 8; i++) {
        HeatNode* child = static_cast<HeatNode*>(children[i]);
        if (child != NULL) {
          sum += child->heat;
          ++count;
        }
      }
    }
    return count > 0 ? sum / count : heat;
  }

  // hides OcTreeNode's
  void updateOccupancyChildren() {
    this->setLogOdds(static_cast<float>(this->getMeanChildLogOdds()));
    heat = getAverageChildHeat();
  }

  std::istream& readData(std::istream& s) {
    OcTreeNode::readData(s);
    s.read(reinterpret_cast<char*>(&heat), sizeof(heat));
    return s;
  }
  std::ostream& writeData(std::ostream& s) const {
    OcTreeNode::writeData(s);
    s.write(reinterpret_cast<const char*>(&heat), sizeof(heat));
    return s;
  }

 protected:
  unsigned heat;
  std::vector<unsigned> visits;  // memory of its own: copies and destructors must be right
};

class HeatTree : public OCTO::OccupancyOcTreeBase<HeatNode> {
 public:
  HeatTree(double resolution) : OCTO::OccupancyOcTreeBase<HeatNode>(resolution) { initializer.ensureLinking(); }

  HeatTree* create() const { return new HeatTree(resolution); }
  std::string getTreeType() const { return "HeatTree"; }

  virtual bool isNodeCollapsible(const HeatNode* node) const {
    if (!nodeChildExists(node, 0)) return false;
    const HeatNode* first = getNodeChild(node, 0);
    if (nodeHasChildren(first)) return false;
    for (unsigned int i = 1; i < 8; i++) {
      if (!nodeChildExists(node, i) || nodeHasChildren(getNodeChild(node, i)) ||
          !(getNodeChild(node, i)->getValue() == first->getValue()))
        return false;
    }
    return true;
  }

  virtual bool pruneNode(HeatNode* node) {
    if (!isNodeCollapsible(node)) return false;
    const unsigned heat = node->getAverageChildHeat();
    node->copyData(*(getNodeChild(node, 0)));
    node->heat = heat;
    for (unsigned int i = 0; i < 8; i++) deleteNodeChild(node, i);
    delete[] node->children;
    node->children = NULL;
    return true;
  }

  virtual void expandNode(HeatNode* node) {
    assert(!nodeHasChildren(node));
    for (unsigned int k = 0; k < 8; k++) {
      HeatNode* child = createNodeChild(node, k);
      child->copyData(*node);
      child->heat /= 2;
    }
  }

  // The order of calls leaves its mark.
  virtual void updateNodeLogOdds(HeatNode* node, const float& update) const {
    OCTO::OccupancyOcTreeBase<HeatNode>::updateNodeLogOdds(node, update);
    node->addHeat(++calls % 11);
  }

  void updateInnerOccupancy() {
    if (this->root != NULL) this->updateInnerOccupancyRecurs(this->root, 0);
  }

  // An update of its own, as derived classes spell it out.
  HeatNode* warmUp(const OCTO_KEY& key, float log_odds) {
    if (root == NULL || this->tree_size == 0) return this->updateNode(key, log_odds);
    return this->updateNodeRecurs(this->root, false, key, 0, log_odds, false);
  }

  double halfWidth() const { return this->resolution * this->tree_max_val; }
  unsigned rootHeat() const { return root ? this->root->getHeat() : 0; }

 protected:
  void updateInnerOccupancyRecurs(HeatNode* node, unsigned int depth) {
    if (nodeHasChildren(node)) {
      if (depth < this->tree_depth) {
        for (unsigned int i = 0; i < 8; i++)
          if (nodeChildExists(node, i)) updateInnerOccupancyRecurs(getNodeChild(node, i), depth + 1);
      }
      node->updateOccupancyChildren();
    }
  }

  class StaticMemberInitializer {
   public:
    StaticMemberInitializer() {
      HeatTree* tree = new HeatTree(0.1);
      tree->clearKeyRays();
      AbstractOcTree::registerTreeType(tree);
    }
    void ensureLinking() {}
  };
  static StaticMemberInitializer initializer;

  mutable unsigned calls = 0;
};

inline HeatTree::StaticMemberInitializer HeatTree::initializer;
