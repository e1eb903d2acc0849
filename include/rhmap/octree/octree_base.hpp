// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rhmap/core/block_store.hpp"
#include "rhmap/octree/abstract_octree.hpp"
#include "rhmap/octree/iterators.hpp"
#include "rhmap/octree/key_space.hpp"
#include "rhmap/octree/overrides.hpp"
#include "rhmap/octree/ray.hpp"
#include "rhmap/octree/structure.hpp"
#include "rhmap/octree/unknown_space.hpp"

namespace rhmap {

using octomap::point3d_list;

/// A tree of NODEs without a notion of occupancy, under OctoMap's names and with OctoMap's answers. `INTERFACE` is
/// AbstractOcTree or AbstractOccupancyOcTree.
///
/// Const members may be called from any number of threads at once. Addresses of nodes stay valid until that node is
/// pruned or deleted. Points outside of the tree (32768 cells from the origin along an axis) and points that are not
/// finite are "not there": null, false, or end.
template <class NODE, class INTERFACE>
class OcTreeBaseImpl : public INTERFACE {
 public:
  using NodeType = NODE;
  using iterator_base = OcTreeIteratorBase<OcTreeBaseImpl>;
  using tree_iterator = OcTreeTreeIterator<OcTreeBaseImpl>;
  using leaf_iterator = OcTreeLeafIterator<OcTreeBaseImpl>;
  using leaf_bbx_iterator = OcTreeLeafBbxIterator<OcTreeBaseImpl>;
  using iterator = leaf_iterator;

  /// An empty tree with cells of this edge length [m].
  OcTreeBaseImpl(double resolution) : keys_(resolution) {}  // NOLINT: implicit, as OctoMap's is
  OcTreeBaseImpl(const OcTreeBaseImpl& other) : INTERFACE(other), keys_(other.keys_) {
    store_->copyFrom(*other.store_);
  }
  OcTreeBaseImpl& operator=(const OcTreeBaseImpl&) = delete;

  /// Swaps the nodes, and nothing else, with another tree.
  void swapContent(OcTreeBaseImpl& other) {
    store_.swap(other.store_);
    store_->swapObservers(*other.store_);  // who observes a tree keeps observing that tree
    bounds_.reset();
    other.bounds_.reset();
  }

  /// Same resolution, same nodes, same values, inner nodes included.
  bool operator==(const OcTreeBaseImpl& other) const {
    return getResolution() == other.getResolution() && *store_ == *other.store_;
  }

  std::string getTreeType() const override { return "OcTreeBaseImpl"; }

  /// Edge length of a cell [m]. Setting it keeps the nodes: the map is scaled.
  double getResolution() const final { return keys_.resolution(); }
  void setResolution(double resolution) override {
    keys_ = KeySpace(resolution);
    bounds_.reset();
  }
  unsigned getTreeDepth() const { return kTreeDepth; }
  /// Edge length of a node at this depth [m].
  double getNodeSize(unsigned depth) const { return keys_.nodeSize(depth); }

  // --- structure by node pointer ---

  NODE* getRoot() const { return nodeOrNull(store_->root()); }
  bool nodeChildExists(const NODE* node, unsigned child) const { return childrenOf(node).has(child); }
  bool nodeHasChildren(const NODE* node) const { return childrenOf(node).mask != 0; }
  /// The child, which must exist.
  NODE* getNodeChild(NODE* node, unsigned child) const { return childrenOf(node).nodes + child; }
  const NODE* getNodeChild(const NODE* node, unsigned child) const { return childrenOf(node).nodes + child; }

  /// Makes a child, or returns the one that is there already. Not below depth 16: null.
  NODE* createNodeChild(NODE* node, unsigned child) {
    const NodeRef at = store_->locate(node);
    if (!at) return nullptr;
    if (const Octet<NODE> children = store_->children(at); children.has(child)) return children.nodes + child;
    return store_->node(store_->createChild(at, static_cast<int>(child)));
  }
  /// Removes a child and all below it. Does nothing where there is none.
  void deleteNodeChild(NODE* node, unsigned child) {
    if (!nodeChildExists(node, child)) return;
    const NodeRef octet = store_->childOctetOf(store_->locate(node));
    store_->removeSubtree({octet.block, octet.slot * 8 + static_cast<int>(child)});
  }

  // The rules of pruning and expanding. All members that change the structure obey a subclass that overrides them.

  /// All eight children exist, are leaves and are equal.
  virtual bool isNodeCollapsible(const NODE* node) const {
    const NodeRef at = store_->locate(node);
    return at && structure::isCollapsible(*store_, at);
  }
  /// Gives a leaf eight children with its data. Does nothing at depth 16 or where there are children.
  virtual void expandNode(NODE* node) {
    if (const NodeRef at = store_->locate(node); at && !store_->hasChildren(at)) structure::expand(*store_, at);
  }
  /// Replaces eight equal leaf children by this node; false if it is not collapsible.
  virtual bool pruneNode(NODE* node) {
    const NodeRef at = store_->locate(node);
    if (!at || !isNodeCollapsible(node)) return false;
    store_->touch(at.block);
    if (const Octet<NODE> children = store_->children(at); children.has(0)) node->copyData(children.nodes[0]);
    structure::removeBelow(*store_, at);
    return true;
  }

  // --- search and deletion ---

  /// The node at `depth` (0: cells, i.e. 16) or the shallower leaf that contains it; null where unknown.
  NODE* search(const OcTreeKey& key, unsigned depth = 0) const {
    return depth % kTreeDepth == 0 ? store_->findNode(key) : searchAtDepth(key, depth);
  }
  NODE* search(const point3d& value, unsigned depth = 0) const {
    OcTreeKey key;
    return keys_.coordToKeyChecked(value, key) ? search(key, depth) : nullptr;
  }
  NODE* search(double x, double y, double z, unsigned depth = 0) const {
    OcTreeKey key;
    return keys_.coordToKeyChecked(x, y, z, key) ? search(key, depth) : nullptr;
  }

  /// Deletes the node at `depth` (0: 16) with all below it, expanding pruned leaves on the way; ancestors that lose
  /// their last child go with it, except the root. True if the root lost its last child or there was none: OctoMap's
  /// answer.
  bool deleteNode(const OcTreeKey& key, unsigned depth = 0) {
    return structure::deleteNode(*store_, key, depth == 0 ? kTreeDepth : depth, expander());
  }
  bool deleteNode(const point3d& value, unsigned depth = 0) {
    OcTreeKey key;
    return keys_.coordToKeyChecked(value, key) && deleteNode(key, depth);
  }
  bool deleteNode(double x, double y, double z, unsigned depth = 0) {
    OcTreeKey key;
    return keys_.coordToKeyChecked(x, y, z, key) && deleteNode(key, depth);
  }

  void clear() override { store_->clear(); }
  /// Collapses level by level from the cells up, and stops at the first level where nothing collapsed, as OctoMap does.
  void prune() override {
    if (hasOctomapsStructure()) {
      structure::pruneLevels(*store_, [this](NodeRef at) { return structure::prune(*store_, at); });
    } else {
      structure::pruneLevels(*store_, [this](NodeRef at) { return pruneNode(store_->node(at)); });
    }
  }
  /// Expands every leaf down to depth 16.
  void expand() override { structure::expandAll(*store_, expander()); }

  /// Appends the centres [m] of what is unknown in a box, at `depth` (0: cells). As OctoMap samples it: without the
  /// first layer along each axis, with the last, and with corners outside of the tree wrapped around (see sampleBox). A
  /// box that is inside out holds nothing. Throws std::length_error for a box of more than 2^33 nodes.
  void getUnknownLeafCenters(point3d_list& node_centers, point3d pmin, point3d pmax, unsigned int depth = 0) const {
    forEachUnknown(*store_, keys_, pmin, pmax, depth, [&](const point3d& centre) { node_centers.push_back(centre); });
  }

  // --- statistics ---

  /// Number of nodes, inner ones included.
  std::size_t size() const override { return store_->size(); }
  std::size_t calcNumNodes() const { return store_->size(); }
  std::size_t getNumLeafNodes() const {
    std::size_t leaves = 0;
    for (auto it = begin(), last = end(); it != last; ++it) ++leaves;
    return leaves;
  }
  /// Bytes that this tree holds. (OctoMap's own figure is a model that leaves out what the allocator adds.)
  std::size_t memoryUsage() const override { return sizeof(*this) + sizeof(*store_) + store_->memoryUsage(); }
  std::size_t memoryUsageNode() const override { return sizeof(NODE); }
  /// Bytes of a dense grid over the metric bounds.
  unsigned long long memoryFullGrid() const {
    if (store_->empty()) return 0;
    double x, y, z;
    getMetricSize(x, y, z);
    const double r = getResolution();
    return static_cast<unsigned long long>((x / r) * (y / r) * (z / r) * sizeof(getRoot()->getValue()));
  }
  /// Volume of the metric bounds [m^3].
  double volume() {
    double x, y, z;
    getMetricSize(x, y, z);
    return x * y * z;
  }

  // Bounds of all leaves, free ones too [m]; zeros for an empty tree. The non-const forms remember the answer until the
  // structure changes, and so are not for several threads.
  void getMetricMin(double& x, double& y, double& z) override { spread(cachedBounds().min, x, y, z); }
  void getMetricMin(double& x, double& y, double& z) const override { spread(knownBounds().min, x, y, z); }
  void getMetricMax(double& x, double& y, double& z) override { spread(cachedBounds().max, x, y, z); }
  void getMetricMax(double& x, double& y, double& z) const override { spread(knownBounds().max, x, y, z); }
  void getMetricSize(double& x, double& y, double& z) override { spread(cachedBounds().size(), x, y, z); }
  virtual void getMetricSize(double& x, double& y, double& z) const { spread(knownBounds().size(), x, y, z); }

  // --- rays ---

  /// Keys from the origin's cell (included) to the end's (not included); empty if they are the same. False if one of
  /// the points is outside of the tree.
  bool computeRayKeys(const point3d& origin, const point3d& end, KeyRay& ray) const {
    return rhmap::computeRayKeys(keys_, origin, end, ray);
  }
  /// Centres of the ray's cells [m].
  bool computeRay(const point3d& origin, const point3d& end, std::vector<point3d>& ray) const {
    ray.clear();
    return rhmap::forEachRayKey(keys_, origin, end, [&](const OcTreeKey& key) { ray.push_back(keyToCoord(key)); });
  }
  /// There are no ray buffers to clear; kept for code that calls it.
  void clearKeyRays() {}

  // --- files ---

  std::istream& readData(std::istream& s) override;
  std::ostream& writeData(std::ostream& s) const override;

  // --- iterators ---

  iterator begin(unsigned char max_depth = 0) const { return iterator(this, max_depth); }
  iterator end() const { return {}; }
  leaf_iterator begin_leafs(unsigned char max_depth = 0) const { return leaf_iterator(this, max_depth); }
  leaf_iterator end_leafs() const { return {}; }
  leaf_bbx_iterator begin_leafs_bbx(const OcTreeKey& min, const OcTreeKey& max, unsigned char max_depth = 0) const {
    return leaf_bbx_iterator(this, min, max, max_depth);
  }
  leaf_bbx_iterator begin_leafs_bbx(const point3d& min, const point3d& max, unsigned char max_depth = 0) const {
    return leaf_bbx_iterator(this, min, max, max_depth);
  }
  leaf_bbx_iterator end_leafs_bbx() const { return {}; }
  tree_iterator begin_tree(unsigned char max_depth = 0) const { return tree_iterator(this, max_depth); }
  tree_iterator end_tree() const { return {}; }

  // --- keys and coordinates ---

  key_type coordToKey(double x) const { return keys_.coordToKey(x); }
  key_type coordToKey(double x, unsigned depth) const { return keys_.coordToKey(x, depth); }
  OcTreeKey coordToKey(const point3d& p) const { return coordToKey(p.x(), p.y(), p.z()); }
  OcTreeKey coordToKey(double x, double y, double z) const { return {coordToKey(x), coordToKey(y), coordToKey(z)}; }
  OcTreeKey coordToKey(const point3d& p, unsigned depth) const { return coordToKey(p.x(), p.y(), p.z(), depth); }
  OcTreeKey coordToKey(double x, double y, double z, unsigned depth) const {
    return {coordToKey(x, depth), coordToKey(y, depth), coordToKey(z, depth)};
  }
  key_type adjustKeyAtDepth(key_type key, unsigned depth) const { return KeySpace::adjustKeyAtDepth(key, depth); }
  OcTreeKey adjustKeyAtDepth(const OcTreeKey& key, unsigned depth) const {
    return KeySpace::adjustKeyAtDepth(key, depth);
  }
  bool coordToKeyChecked(double x, key_type& key) const { return keys_.coordToKeyChecked(x, key); }
  bool coordToKeyChecked(double x, unsigned depth, key_type& key) const {
    if (!keys_.coordToKeyChecked(x, key)) return false;
    key = adjustKeyAtDepth(key, depth);
    return true;
  }
  bool coordToKeyChecked(const point3d& p, OcTreeKey& key) const { return keys_.coordToKeyChecked(p, key); }
  bool coordToKeyChecked(double x, double y, double z, OcTreeKey& key) const {
    return keys_.coordToKeyChecked(x, y, z, key);
  }
  bool coordToKeyChecked(const point3d& p, unsigned depth, OcTreeKey& key) const {
    return coordToKeyChecked(p.x(), p.y(), p.z(), depth, key);
  }
  bool coordToKeyChecked(double x, double y, double z, unsigned depth, OcTreeKey& key) const {
    return coordToKeyChecked(x, depth, key[0]) && coordToKeyChecked(y, depth, key[1]) &&
           coordToKeyChecked(z, depth, key[2]);
  }
  double keyToCoord(key_type key) const { return keys_.keyToCoord(key); }
  double keyToCoord(key_type key, unsigned depth) const { return keys_.keyToCoord(key, depth); }
  point3d keyToCoord(const OcTreeKey& key) const { return keys_.keyToCoord(key); }
  point3d keyToCoord(const OcTreeKey& key, unsigned depth) const { return keys_.keyToCoord(key, depth); }

  // --- for code that works on the structure itself ---

  const BlockStore<NODE>& store() const { return *store_; }
  const KeySpace& keySpace() const { return keys_; }

 protected:
  struct Bounds {
    std::array<double, 3> min{}, max{};
    std::uint64_t version;  ///< of the store they were computed for
    std::array<double, 3> size() const { return {max[0] - min[0], max[1] - min[1], max[2] - min[2]}; }
  };

  /// No subclass has overridden OctoMap's rules of pruning and expanding.
  bool hasOctomapsStructure() const {
    const VirtualTable now(*this);
    return now.agrees(own_members_, &OcTreeBaseImpl::expandNode) &&
           now.agrees(own_members_, &OcTreeBaseImpl::pruneNode) &&
           now.agrees(own_members_, &OcTreeBaseImpl::isNodeCollapsible);
  }

  /// Expands by the rule of this object's class.
  auto expander() {
    return [this](NodeRef at) { expandNode(store_->node(at)); };
  }

  NODE* nodeOrNull(NodeRef at) const { return store_->nodeOrNull(at); }

  /// search() at other depths than the cells': apart from it, so that it stays short.
  [[gnu::noinline]] NODE* searchAtDepth(const OcTreeKey& key, unsigned depth) const {
    return nodeOrNull(store_->search(key, depth));
  }

  Octet<NODE> childrenOf(const NODE* node) const {
    const NodeRef at = store_->locate(node);
    return at ? store_->children(at) : Octet<NODE>{};
  }

  // OctoMap's names, for subclasses.

  /// Stands for OctoMap's member of this name: the root node, null in an empty tree.
  struct Root {
    const OcTreeBaseImpl* tree;
    operator NODE*() const { return tree->getRoot(); }  // NOLINT
    NODE* operator->() const { return tree->getRoot(); }
  };
  /// Stands for OctoMap's member of this name: the number of nodes. The tree keeps it up to date by itself.
  struct TreeSize {
    const OcTreeBaseImpl* tree;
    operator std::size_t() const { return tree->store_->size(); }  // NOLINT
  };
  const Root root{this};
  const TreeSize tree_size{this};
  static constexpr unsigned tree_depth = kTreeDepth;
  static constexpr unsigned tree_max_val = kTreeMaxVal;

  std::unique_ptr<BlockStore<NODE>> store_ = std::make_unique<BlockStore<NODE>>();
  KeySpace keys_;
  const double& resolution = keys_.resolution();                // [m]
  const double& resolution_factor = keys_.inverseResolution();  // [1/m]
  std::optional<Bounds> bounds_;                                // the last that the non-const getters computed

 private:
  const VirtualTable own_members_{*this};  // before any subclass overrides them

  static void spread(const std::array<double, 3>& v, double& x, double& y, double& z) {
    x = v[0];
    y = v[1];
    z = v[2];
  }
  bool boundsAreKnown() const { return bounds_ && bounds_->version == store_->version(); }
  const Bounds& cachedBounds() {
    if (!boundsAreKnown())
      bounds_ = computeBounds([](double centre, double size) { return centre - size / 2.0 + size; });
    return *bounds_;
  }
  /// OctoMap rounds the upper end in another way where it has nothing cached.
  Bounds knownBounds() const {
    return boundsAreKnown() ? *bounds_ : computeBounds([](double centre, double size) { return centre + size / 2.0; });
  }
  template <class Upper>
  Bounds computeBounds(Upper&& upper) const;
};

/// A tree of NODEs that do not hold occupancy; the base of CountingOcTree.
template <class NODE>
class OcTreeBase : public OcTreeBaseImpl<NODE, AbstractOcTree> {
  using Base = OcTreeBaseImpl<NODE, AbstractOcTree>;

 public:
  OcTreeBase(double resolution) : Base(resolution) {}  // NOLINT: implicit, as OctoMap's is

  OcTreeBase* create() const override { return new OcTreeBase(this->getResolution()); }
  std::string getTreeType() const override { return "OcTreeBase"; }
};

}  // namespace rhmap

#include "rhmap/octree/octree_base_members.hpp"
