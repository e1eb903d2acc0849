// SPDX-License-Identifier: BSD-3-Clause
// Every public member of OctoMap's trees with its exact signature, so that code which overrides them or takes their
// address compiles, too. The list is compiled against stock OctoMap as well: it says of both what it says of one.
#include <gtest/gtest.h>

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <octomap/OcTreeStamped.h>

#include <concepts>
#include <memory>
#include <sstream>

#include "rhmap/octree/color_octree.hpp"
#include "rhmap/octree/counting_octree.hpp"
#include "rhmap/octree/octree.hpp"
#include "rhmap/octree/stamped_octree.hpp"

namespace rhmap {
namespace {

/// `name` exists in TREE and can be called as R(ARGS...) const or not.
#define MEMBER(R, name, ...) static_cast<void>(static_cast<R (TREE::*)(__VA_ARGS__)>(&TREE::name))
#define CONST_MEMBER(R, name, ...) static_cast<void>(static_cast<R (TREE::*)(__VA_ARGS__) const>(&TREE::name))

using Key = OcTreeKey;
using Cloud = octomap::Pointcloud;

/// What all trees have, of whatever nodes.
template <class TREE, class BASE>
void anyTree() {
  using NODE = typename TREE::NodeType;
  CONST_MEMBER(TREE*, create);
  CONST_MEMBER(std::string, getTreeType);
  MEMBER(void, swapContent, BASE&);
  CONST_MEMBER(bool, operator==, const BASE&);
  MEMBER(void, setResolution, double);
  CONST_MEMBER(double, getResolution);
  CONST_MEMBER(unsigned, getTreeDepth);
  CONST_MEMBER(double, getNodeSize, unsigned);
  MEMBER(void, clearKeyRays);
  MEMBER(NODE*, createNodeChild, NODE*, unsigned);
  MEMBER(void, deleteNodeChild, NODE*, unsigned);
  CONST_MEMBER(NODE*, getNodeChild, NODE*, unsigned);
  CONST_MEMBER(const NODE*, getNodeChild, const NODE*, unsigned);
  CONST_MEMBER(bool, isNodeCollapsible, const NODE*);
  CONST_MEMBER(bool, nodeChildExists, const NODE*, unsigned);
  CONST_MEMBER(bool, nodeHasChildren, const NODE*);
  MEMBER(void, expandNode, NODE*);
  MEMBER(bool, pruneNode, NODE*);
  CONST_MEMBER(NODE*, getRoot);
  CONST_MEMBER(NODE*, search, double, double, double, unsigned);
  CONST_MEMBER(NODE*, search, const point3d&, unsigned);
  CONST_MEMBER(NODE*, search, const Key&, unsigned);
  MEMBER(bool, deleteNode, double, double, double, unsigned);
  MEMBER(bool, deleteNode, const point3d&, unsigned);
  MEMBER(bool, deleteNode, const Key&, unsigned);
  MEMBER(void, clear);
  MEMBER(void, prune);
  MEMBER(void, expand);
  CONST_MEMBER(std::size_t, size);
  CONST_MEMBER(std::size_t, memoryUsage);
  CONST_MEMBER(std::size_t, memoryUsageNode);
  CONST_MEMBER(unsigned long long, memoryFullGrid);
  MEMBER(double, volume);
  MEMBER(void, getMetricSize, double&, double&, double&);
  CONST_MEMBER(void, getMetricSize, double&, double&, double&);
  MEMBER(void, getMetricMin, double&, double&, double&);
  CONST_MEMBER(void, getMetricMin, double&, double&, double&);
  MEMBER(void, getMetricMax, double&, double&, double&);
  CONST_MEMBER(void, getMetricMax, double&, double&, double&);
  CONST_MEMBER(std::size_t, calcNumNodes);
  CONST_MEMBER(std::size_t, getNumLeafNodes);
  CONST_MEMBER(void, getUnknownLeafCenters, octomap::point3d_list&, point3d, point3d, unsigned);
  CONST_MEMBER(bool, computeRayKeys, const point3d&, const point3d&, KeyRay&);
  MEMBER(std::istream&, readData, std::istream&);
  CONST_MEMBER(std::ostream&, writeData, std::ostream&);
  CONST_MEMBER(typename TREE::iterator, begin, unsigned char);
  CONST_MEMBER(typename TREE::leaf_iterator, begin_leafs, unsigned char);
  CONST_MEMBER(typename TREE::leaf_bbx_iterator, begin_leafs_bbx, const Key&, const Key&, unsigned char);
  CONST_MEMBER(typename TREE::leaf_bbx_iterator, begin_leafs_bbx, const point3d&, const point3d&, unsigned char);
  CONST_MEMBER(typename TREE::tree_iterator, begin_tree, unsigned char);
  CONST_MEMBER(key_type, coordToKey, double);
  CONST_MEMBER(key_type, coordToKey, double, unsigned);
  CONST_MEMBER(Key, coordToKey, const point3d&);
  CONST_MEMBER(Key, coordToKey, double, double, double);
  CONST_MEMBER(Key, coordToKey, const point3d&, unsigned);
  CONST_MEMBER(Key, coordToKey, double, double, double, unsigned);
  CONST_MEMBER(Key, adjustKeyAtDepth, const Key&, unsigned);
  CONST_MEMBER(key_type, adjustKeyAtDepth, key_type, unsigned);
  CONST_MEMBER(bool, coordToKeyChecked, const point3d&, Key&);
  CONST_MEMBER(bool, coordToKeyChecked, const point3d&, unsigned, Key&);
  CONST_MEMBER(bool, coordToKeyChecked, double, double, double, Key&);
  CONST_MEMBER(bool, coordToKeyChecked, double, double, double, unsigned, Key&);
  CONST_MEMBER(bool, coordToKeyChecked, double, key_type&);
  CONST_MEMBER(bool, coordToKeyChecked, double, unsigned, key_type&);
  CONST_MEMBER(double, keyToCoord, key_type, unsigned);
  CONST_MEMBER(double, keyToCoord, key_type);
  CONST_MEMBER(point3d, keyToCoord, const Key&);
  CONST_MEMBER(point3d, keyToCoord, const Key&, unsigned);
  CONST_MEMBER(bool, write, const std::string&);
  CONST_MEMBER(bool, write, std::ostream&);
}

/// What occupancy trees have besides.
template <class TREE, class BASE, class OCCUPANCY_NODE>
void occupancyTree() {
  using NODE = typename TREE::NodeType;
  anyTree<TREE, BASE>();
  MEMBER(void, insertPointCloud, const Cloud&, const point3d&, double, bool, bool);
  MEMBER(void, insertPointCloud, const Cloud&, const point3d&, const octomap::pose6d&, double, bool, bool);
  MEMBER(void, insertPointCloud, const octomap::ScanNode&, double, bool, bool);
  MEMBER(void, insertPointCloudRays, const Cloud&, const point3d&, double, bool);
  MEMBER(NODE*, setNodeValue, const Key&, float, bool);
  MEMBER(NODE*, setNodeValue, const point3d&, float, bool);
  MEMBER(NODE*, setNodeValue, double, double, double, float, bool);
  MEMBER(NODE*, updateNode, const Key&, float, bool);
  MEMBER(NODE*, updateNode, const point3d&, float, bool);
  MEMBER(NODE*, updateNode, double, double, double, float, bool);
  MEMBER(NODE*, updateNode, const Key&, bool, bool);
  MEMBER(NODE*, updateNode, const point3d&, bool, bool);
  MEMBER(NODE*, updateNode, double, double, double, bool, bool);
  MEMBER(void, toMaxLikelihood);
  MEMBER(bool, insertRay, const point3d&, const point3d&, double, bool);
  CONST_MEMBER(bool, castRay, const point3d&, const point3d&, point3d&, bool, double);
  CONST_MEMBER(bool, getRayIntersection, const point3d&, const point3d&, const point3d&, point3d&, double);
  CONST_MEMBER(bool, getNormals, const point3d&, std::vector<point3d>&, bool);
  MEMBER(void, useBBXLimit, bool);
  CONST_MEMBER(bool, bbxSet);
  CONST_MEMBER(point3d, getBBXMin);
  CONST_MEMBER(point3d, getBBXMax);
  CONST_MEMBER(point3d, getBBXBounds);
  CONST_MEMBER(point3d, getBBXCenter);
  CONST_MEMBER(bool, inBBX, const point3d&);
  CONST_MEMBER(bool, inBBX, const Key&);
  MEMBER(void, enableChangeDetection, bool);
  CONST_MEMBER(bool, isChangeDetectionEnabled);
  MEMBER(void, resetChangeDetection);
  CONST_MEMBER(octomap::KeyBoolMap::const_iterator, changedKeysBegin);
  CONST_MEMBER(octomap::KeyBoolMap::const_iterator, changedKeysEnd);
  CONST_MEMBER(std::size_t, numChangesDetected);
  MEMBER(void, computeUpdate, const Cloud&, const point3d&, octomap::KeySet&, octomap::KeySet&, double);
  MEMBER(void, computeDiscreteUpdate, const Cloud&, const point3d&, octomap::KeySet&, octomap::KeySet&, double);
  MEMBER(std::istream&, readBinaryData, std::istream&);
  MEMBER(std::istream&, readBinaryNode, std::istream&, NODE*);
  CONST_MEMBER(std::ostream&, writeBinaryNode, std::ostream&, const NODE*);
  CONST_MEMBER(std::ostream&, writeBinaryData, std::ostream&);
  MEMBER(void, updateInnerOccupancy);
  CONST_MEMBER(void, integrateHit, NODE*);
  CONST_MEMBER(void, integrateMiss, NODE*);
  CONST_MEMBER(void, updateNodeLogOdds, NODE*, const float&);
  CONST_MEMBER(void, nodeToMaxLikelihood, NODE*);
  CONST_MEMBER(void, nodeToMaxLikelihood, NODE&);
  CONST_MEMBER(bool, isNodeOccupied, const OCCUPANCY_NODE*);
  CONST_MEMBER(bool, isNodeOccupied, const OCCUPANCY_NODE&);
  CONST_MEMBER(bool, isNodeAtThreshold, const OCCUPANCY_NODE*);
  CONST_MEMBER(bool, isNodeAtThreshold, const OCCUPANCY_NODE&);
  MEMBER(bool, writeBinary, const std::string&);
  MEMBER(bool, writeBinary, std::ostream&);
  CONST_MEMBER(bool, writeBinaryConst, const std::string&);
  CONST_MEMBER(bool, writeBinaryConst, std::ostream&);
  MEMBER(bool, readBinary, const std::string&);
  MEMBER(bool, readBinary, std::istream&);
  MEMBER(void, setOccupancyThres, double);
  MEMBER(void, setProbHit, double);
  MEMBER(void, setProbMiss, double);
  MEMBER(void, setClampingThresMin, double);
  MEMBER(void, setClampingThresMax, double);
  CONST_MEMBER(double, getOccupancyThres);
  CONST_MEMBER(float, getOccupancyThresLog);
  CONST_MEMBER(double, getProbHit);
  CONST_MEMBER(float, getProbHitLog);
  CONST_MEMBER(double, getProbMiss);
  CONST_MEMBER(float, getProbMissLog);
  CONST_MEMBER(double, getClampingThresMin);
  CONST_MEMBER(float, getClampingThresMinLog);
  CONST_MEMBER(double, getClampingThresMax);
  CONST_MEMBER(float, getClampingThresMaxLog);
}

template <class NODE>
concept OccupancyNode = requires(NODE node, const NODE& other, float f, unsigned i, std::stringstream s) {
  { other.getOccupancy() } -> std::same_as<double>;
  { other.getLogOdds() } -> std::same_as<float>;
  { other.getValue() } -> std::same_as<float>;
  { other.getMeanChildLogOdds() } -> std::same_as<double>;
  { other.getMaxChildLogOdds() } -> std::same_as<float>;
  { other == other } -> std::same_as<bool>;
  { node.readData(s) } -> std::same_as<std::istream&>;
  { other.writeData(s) } -> std::same_as<std::ostream&>;
  node.setLogOdds(f);
  node.setValue(f);
  node.addValue(f);
  node.updateOccupancyChildren();
  node.copyData(other);
  requires std::same_as<typename NODE::DataType, float>;
};

TEST(Interface, HasOctomapsMembersWithOctomapsSignatures) {
  using OurBase = OcTreeBaseImpl<OcTreeNode, AbstractOccupancyOcTree>;
  using TheirBase = octomap::OcTreeBaseImpl<octomap::OcTreeNode, octomap::AbstractOccupancyOcTree>;
  occupancyTree<OcTree, OurBase, OcTreeNode>();
  occupancyTree<octomap::OcTree, TheirBase, octomap::OcTreeNode>();
  occupancyTree<ColorOcTree, OcTreeBaseImpl<ColorOcTreeNode, AbstractOccupancyOcTree>, OcTreeNode>();
  occupancyTree<OcTreeStamped, OcTreeBaseImpl<OcTreeNodeStamped, AbstractOccupancyOcTree>, OcTreeNode>();
  anyTree<CountingOcTree, OcTreeBaseImpl<CountingOcTreeNode, AbstractOcTree>>();
  static_assert(OccupancyNode<OcTreeNode> && OccupancyNode<octomap::OcTreeNode>);
  static_assert(OccupancyNode<ColorOcTreeNode> && OccupancyNode<octomap::ColorOcTreeNode>);
  static_assert(OccupancyNode<OcTreeNodeStamped> && OccupancyNode<octomap::OcTreeNodeStamped>);
}

/// Virtual where OctoMap's are: a subclass can override them, and calls through the base class reach it.
class Overrider : public OcTree {
 public:
  using OcTree::OcTree;
  void insertPointCloud(const Cloud&, const point3d&, double, bool, bool) override {}
  void insertPointCloud(const Cloud&, const point3d&, const octomap::pose6d&, double, bool, bool) override {}
  void insertPointCloud(const octomap::ScanNode&, double, bool, bool) override {}
  void insertPointCloudRays(const Cloud&, const point3d&, double, bool) override {}
  OcTreeNode* setNodeValue(const Key&, float, bool) override { return nullptr; }
  OcTreeNode* setNodeValue(const point3d&, float, bool) override { return nullptr; }
  OcTreeNode* setNodeValue(double, double, double, float, bool) override { return nullptr; }
  OcTreeNode* updateNode(const Key&, float, bool) override { return nullptr; }
  OcTreeNode* updateNode(const point3d&, float, bool) override { return nullptr; }
  OcTreeNode* updateNode(double, double, double, float, bool) override { return nullptr; }
  OcTreeNode* updateNode(const Key&, bool, bool) override { return nullptr; }
  OcTreeNode* updateNode(const point3d&, bool, bool) override { return nullptr; }
  OcTreeNode* updateNode(double, double, double, bool, bool) override { return nullptr; }
  void toMaxLikelihood() override {}
  bool insertRay(const point3d&, const point3d&, double, bool) override { return false; }
  bool castRay(const point3d&, const point3d&, point3d&, bool, double) const override { return false; }
  bool getRayIntersection(const point3d&, const point3d&, const point3d&, point3d&, double) const override {
    return false;
  }
  void integrateHit(OcTreeNode*) const override {}
  void integrateMiss(OcTreeNode*) const override {}
  void updateNodeLogOdds(OcTreeNode*, const float&) const override {}
  void nodeToMaxLikelihood(OcTreeNode*) const override {}
  void nodeToMaxLikelihood(OcTreeNode&) const override {}
  bool isNodeCollapsible(const OcTreeNode*) const override { return false; }
  void expandNode(OcTreeNode*) override {}
  bool pruneNode(OcTreeNode*) override { return false; }
  void prune() override {}
  void expand() override {}
  std::size_t size() const override { return 17; }
  std::size_t memoryUsage() const override { return 0; }
  std::size_t memoryUsageNode() const override { return 0; }
  void getMetricSize(double&, double&, double&) override {}
  void getMetricSize(double&, double&, double&) const override {}
  void getMetricMin(double&, double&, double&) override {}
  void getMetricMax(double&, double&, double&) override {}
};

TEST(Interface, IsVirtualWhereOctomapsIs) {
  const std::unique_ptr<AbstractOcTree> tree = std::make_unique<Overrider>(0.1);
  EXPECT_EQ(tree->size(), 17U);
}

}  // namespace
}  // namespace rhmap
