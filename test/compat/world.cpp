// SPDX-License-Identifier: BSD-3-Clause
#include "world.hpp"

#include <octomap/ColorOcTree.h>
#include <octomap/octomap.h>

#include <memory>
#include <sstream>
#include <stdexcept>

#include "project/dice.hpp"

namespace rhmap::test {
namespace {

template <class Tree>
std::string otFile(const Tree& tree) {
  std::ostringstream s;
  tree.write(s);
  return s.str();
}

// --- messages, in the way of octomap_msgs/conversions.h ---

template <class Tree>
Message toMessage(const Tree& tree, bool binary) {
  std::stringstream s;
  if (binary) {
    tree.writeBinaryData(s);
  } else {
    tree.writeData(s);
  }
  const std::string bytes = s.str();
  return {binary, tree.getTreeType(), tree.getResolution(), std::vector<std::int8_t>(bytes.begin(), bytes.end())};
}

template <class Tree>
std::unique_ptr<octomap::AbstractOcTree> fromBinary(const Message& message, std::istream& s) {
  auto tree = std::make_unique<Tree>(message.resolution);
  tree->readBinaryData(s);
  return tree;
}

std::unique_ptr<octomap::AbstractOcTree> toMap(const Message& message) {
  std::stringstream s;
  s.write(reinterpret_cast<const char*>(message.data.data()), static_cast<std::streamsize>(message.data.size()));
  if (message.binary) {
    return message.id == "ColorOcTree" ? fromBinary<octomap::ColorOcTree>(message, s)
                                       : fromBinary<octomap::OcTree>(message, s);
  }
  std::unique_ptr<octomap::AbstractOcTree> tree(octomap::AbstractOcTree::createTree(message.id, message.resolution));
  if (tree) tree->readData(s);
  return tree;
}

// --- maps to send ---

template <class Tree>
Tree room() {
  Tree tree(0.1);
  Dice dice(11);
  for (int i = 0; i < 4; ++i) {
    const octomap::point3d origin(static_cast<float>(i) - 1.5F, 0, 0);
    tree.insertPointCloud(roomScan(origin, 2000, dice), origin);
  }
  return tree;
}

octomap::ColorOcTree colouredRoom() {
  octomap::ColorOcTree tree = room<octomap::ColorOcTree>();
  Dice dice(12);
  for (int i = 0; i < 5000; ++i) {
    const auto colour = [&] { return static_cast<std::uint8_t>(dice.below(256)); };
    const octomap::OcTreeKey key = tree.coordToKey(dice.point(3));
    const std::uint8_t r = colour(), g = colour(), b = colour();
    tree.setNodeColor(key, r, g, b);
  }
  tree.updateInnerOccupancy();
  return tree;
}

// --- calls ---

/// Inserts a scan by its own sets of keys.
void insertBySets(octomap::OcTree& tree, const octomap::point3d& origin, const octomap::Pointcloud& scan) {
  octomap::KeySet free, occupied;
  octomap::KeyRay ray;
  for (const octomap::point3d& p : scan) {
    if (tree.computeRayKeys(origin, p, ray)) free.insert(ray.begin(), ray.end());
    occupied.insert(tree.coordToKey(p));
  }
  for (const octomap::OcTreeKey& key : occupied) free.erase(key);
  for (const octomap::OcTreeKey& key : free) tree.updateNode(key, false, true);
  for (const octomap::OcTreeKey& key : occupied) tree.updateNode(key, true, true);
  tree.updateInnerOccupancy();
}

std::string describe(const octomap::OcTree& tree) {
  std::ostringstream s;
  s.precision(17);
  double x, y, z;
  tree.getMetricMax(x, y, z);
  s << tree.size() << ' ' << tree.getNumLeafNodes() << ' ' << x << ' ' << y << ' ' << z << '\n';
  for (octomap::OcTree::tree_iterator it = tree.begin_tree(12), end = tree.end_tree(); it != end; ++it)
    s << it.getX() << ' ' << it.getSize() << ' ' << it->getOccupancy() << ' ' << it.isLeaf() << '\n';
  Dice dice(13);
  for (int i = 0; i < 500; ++i) {
    octomap::point3d end;
    const bool hit = tree.castRay(octomap::point3d(0, 0, 0.1F), dice.point(1), end, i % 2 == 0, 20.0);
    s << hit << ' ' << end << '\n';
  }
  return s.str();
}

class ThisWorld : public World {
 public:
  bool isRhmap() const override {
#ifdef RHMAP_COMPAT_OCTOMAP
    return true;
#else
    return false;
#endif
  }

  std::vector<std::string> answers() const override {
    std::vector<std::string> all;
    octomap::OcTree tree = room<octomap::OcTree>();
    const auto note = [&] { all.insert(all.end(), {describe(tree), otFile(tree)}); };
    note();
    Dice dice(14);
    insertBySets(tree, octomap::point3d(0, 1, 0), roomScan(octomap::point3d(0, 1, 0), 1500, dice));
    note();
    tree.prune();
    note();
    for (int i = 0; i < 200; ++i) tree.deleteNode(dice.point(2));
    note();
    octomap::OcTree copy(tree);
    copy.expand();
    all.push_back(copy == tree ? "equal" : "different");
    copy.toMaxLikelihood();
    copy.prune();
    all.push_back(otFile(copy));
    tree.setResolution(0.2);
    note();
    tree.clear();
    tree.insertRay(octomap::point3d(0, 0, 0), octomap::point3d(3, 2, 1));
    tree.swapContent(copy);
    note();
    return all;
  }

  Message send(const std::string& type, bool binary) const override {
    if (type == "ColorOcTree") return toMessage(colouredRoom(), binary);
    return toMessage(room<octomap::OcTree>(), binary);
  }

  Received receive(const Message& message) const override {
    const std::unique_ptr<octomap::AbstractOcTree> any = toMap(message);
    if (const auto* tree = dynamic_cast<octomap::OcTree*>(any.get()))
      return {otFile(*tree), toMessage(*tree, message.binary)};
    if (const auto* tree = dynamic_cast<octomap::ColorOcTree*>(any.get()))
      return {otFile(*tree), toMessage(*tree, message.binary)};
    throw std::runtime_error("no tree of type " + message.id);
  }
};

}  // namespace

const World& THIS_WORLD() {
  static const ThisWorld world;
  return world;
}

}  // namespace rhmap::test
