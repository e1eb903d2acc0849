// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/baseline/octomap_nodes.hpp"

namespace rhmap::octomap_nodes {
namespace {

using octomap::AbstractOcTreeNode;
using Node = octomap::OcTreeNode;

/// OctoMap's protected members, as pointers to members: a subclass may name them, and they fit any object.
struct TreeMembers : octomap::OcTree {
  static auto theRoot() { return &TreeMembers::root; }
  static auto treeSize() { return &TreeMembers::tree_size; }
  static auto sizeChanged() { return &TreeMembers::size_changed; }
  static auto clampMin() { return &TreeMembers::clamping_thres_min; }
  static auto clampMax() { return &TreeMembers::clamping_thres_max; }
  static auto hit() { return &TreeMembers::prob_hit_log; }
  static auto miss() { return &TreeMembers::prob_miss_log; }
  static auto threshold() { return &TreeMembers::occ_prob_thres_log; }
};
struct NodeMembers : Node {
  static auto childArray() { return &NodeMembers::children; }
};

AbstractOcTreeNode**& childArray(Node* node) { return node->*NodeMembers::childArray(); }

void removeChildren(octomap::OcTree& tree, Node* node) {
  AbstractOcTreeNode**& array = childArray(node);
  if (array == nullptr) return;
  for (unsigned i = 0; i < 8; ++i) {
    if (array[i] == nullptr) continue;
    removeChildren(tree, static_cast<Node*>(array[i]));
    tree.deleteNodeChild(node, i);
  }
  // OctoMap's own deletions leave the empty array behind, which its destructors then take for children.
  delete[] array;
  array = nullptr;
}

}  // namespace

void copyModel(const AbstractOccupancyOcTree& from, octomap::OcTree& to) {
  to.*TreeMembers::clampMin() = from.getClampingThresMinLog();
  to.*TreeMembers::clampMax() = from.getClampingThresMaxLog();
  to.*TreeMembers::hit() = from.getProbHitLog();
  to.*TreeMembers::miss() = from.getProbMissLog();
  to.*TreeMembers::threshold() = from.getOccupancyThresLog();
  if (to.getResolution() != from.getResolution()) to.setResolution(from.getResolution());
}

Node* makeRoot(octomap::OcTree& tree) {
  Node*& root = tree.*TreeMembers::theRoot();
  if (root != nullptr) return root;
  root = new Node();
  ++(tree.*TreeMembers::treeSize());
  tree.*TreeMembers::sizeChanged() = true;
  return root;
}

Node* child(const octomap::OcTree& tree, Node* node, unsigned i) {
  return tree.nodeChildExists(node, i) ? tree.getNodeChild(node, i) : nullptr;
}

Node* find(const octomap::OcTree& tree, const OcTreeKey& key, unsigned depth) {
  Node* node = tree.getRoot();
  for (unsigned level = kTreeDepth; node != nullptr && level > kTreeDepth - depth; --level)
    node = child(tree, node, octomap::computeChildIdx(key, static_cast<int>(level) - 1));
  return node;
}

void shapeChildren(octomap::OcTree& tree, Node* node, std::uint8_t mask) {
  if (mask == 0) return removeChildren(tree, node);
  AbstractOcTreeNode**& array = childArray(node);
  for (unsigned i = 0; i < 8; ++i) {
    const bool has = array != nullptr && array[i] != nullptr;
    const bool wanted = mask >> i & 1;
    if (wanted && !has) {
      tree.createNodeChild(node, i);
    } else if (has && !wanted) {
      removeChildren(tree, static_cast<Node*>(array[i]));
      tree.deleteNodeChild(node, i);
    }
  }
}

}  // namespace rhmap::octomap_nodes
