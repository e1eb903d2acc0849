// SPDX-License-Identifier: BSD-3-Clause
// What viewers and planners do with a map that came as a file: any tree by its abstract name, nodes at all depths,
// rays.
#include <octomap/AbstractOcTree.h>
#include <octomap/OcTree.h>

#include <cstdio>
#include <memory>
#include <sstream>

#include "dice.hpp"
#include "parts.hpp"

namespace {

/// A hash of everything that an iterator tells.
class Digest {
 public:
  template <class T>
  void add(T value) {
    const unsigned char* bytes = reinterpret_cast<const unsigned char*>(&value);
    for (std::size_t i = 0; i < sizeof value; ++i) hash_ = (hash_ ^ bytes[i]) * 1099511628211ULL;
  }
  template <class Iterator>
  void addNode(const Iterator& it) {
    add(it.getX()), add(it.getY()), add(it.getZ()), add(it.getSize()), add(it.getDepth());
    const octomap::OcTreeKey key = it.getKey(), index = it.getIndexKey();
    for (unsigned i = 0; i < 3; ++i) add(key[i]), add(index[i]);
    const octomap::point3d centre = it.getCoordinate();
    add(centre.x()), add(centre.y()), add(centre.z());
    add(it->getLogOdds()), add((*it).getOccupancy()), add(it->getValue());
  }
  unsigned long long value() const { return hash_; }

 private:
  unsigned long long hash_ = 14695981039346656037ULL;
};

/// Nodes below one, counted and hashed by child pointers.
unsigned walk(const octomap::OcTree& tree, const octomap::OcTreeNode* node, Digest& digest) {
  unsigned count = 1;
  digest.add(node->getLogOdds());
  if (!tree.nodeHasChildren(node)) return count;
  for (unsigned i = 0; i < 8; ++i) {
    if (tree.nodeChildExists(node, i)) count += walk(tree, tree.getNodeChild(node, i), digest);
  }
  return count;
}

void look(const octomap::OcTree& tree) {
  for (unsigned char depth = 0; depth <= 16; depth += 4) {
    Digest leaves, all;
    unsigned n = 0, inner = 0;
    for (octomap::OcTree::leaf_iterator it = tree.begin_leafs(depth); it != tree.end_leafs(); ++it, ++n)
      leaves.addNode(it);
    for (auto it = tree.begin_tree(depth), end = tree.end_tree(); it != end; it++) {
      all.addNode(it);
      inner += it.isLeaf() ? 0 : 1;
    }
    std::printf("depth %u: %u leaves %016llx, %u inner %016llx\n", depth, n, leaves.value(), inner, all.value());
  }
  Digest below;
  const unsigned count = walk(tree, tree.getRoot(), below);
  std::printf("by pointers: %u nodes %016llx\n", count, below.value());

  Dice dice(4);
  unsigned known = 0, hits = 0;
  Digest answers;
  for (int i = 0; i < 2000; ++i) {
    const octomap::point3d p = dice.point(7), direction = dice.point(1);
    for (unsigned depth : {0U, 16U, 13U, 9U}) {
      const octomap::OcTreeNode* node = tree.search(p, depth);
      known += node != NULL;
      if (node) answers.add(node->getOccupancy()), answers.add(tree.isNodeOccupied(node));
    }
    octomap::point3d end(-1, -1, -1);
    hits += tree.castRay(p * 0.2F, direction, end, i % 2 == 0, i % 3 == 0 ? 4.0 : -1.0);
    answers.add(end.x()), answers.add(end.y()), answers.add(end.z());
  }
  std::printf("%u known, %u hits %016llx\n", known, hits, answers.value());
}

}  // namespace

void viewer(const std::string& folder) {
  std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(folder + "/server_pruned.ot"));
  if (!any) return;
  std::printf("a tree of type %s, %.17g m, %zu nodes\n", any->getTreeType().c_str(), any->getResolution(), any->size());
  if (const octomap::OcTree* tree = dynamic_cast<octomap::OcTree*>(any.get())) look(*tree);

  std::unique_ptr<octomap::AbstractOcTree> made(octomap::AbstractOcTree::createTree("OcTree", 0.25));
  octomap::OcTree* tree = dynamic_cast<octomap::OcTree*>(made.get());
  std::printf("made: %d, of no such type: %d\n", tree != NULL,
              octomap::AbstractOcTree::createTree("NoSuchTree", 0.25) != NULL);
  tree->enableChangeDetection(true);
  Dice dice(5);
  for (int i = 0; i < 9000; ++i) tree->updateNode(dice.point(1.5F), dice.below(6) != 0);
  unsigned long long created = 0, keys = 0;
  for (octomap::KeyBoolMap::const_iterator it = tree->changedKeysBegin(); it != tree->changedKeysEnd(); ++it) {
    created += it->second;
    keys += it->first[0] + 3ULL * it->first[1] + 7ULL * it->first[2];
  }
  std::printf("%zu changed, %llu new, keys %llu\n", tree->numChangesDetected(), created, keys);
  std::stringstream full, binary;
  tree->write(full);
  tree->writeBinary(binary);
  octomap::OcTree copy(1.0);
  const bool good = copy.readBinary(binary);
  std::printf("stream read: %d, %zu nodes, resolution %g\n", good, copy.size(), copy.getResolution());
  std::unique_ptr<octomap::AbstractOcTree> same(octomap::AbstractOcTree::read(full));
  std::printf("%zu nodes in the full stream\n", same->size());
  same->write(folder + "/viewer.ot");
  tree->expand();
  std::printf("expanded: %zu nodes\n", tree->size());
  tree->deleteNode(octomap::point3d(0.1F, 0.1F, 0.1F));
  tree->write(folder + "/viewer_expanded.ot");
}
