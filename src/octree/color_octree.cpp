// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/color_octree.hpp"

#include <stdlib.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "rhmap/core/atomic_file.hpp"

namespace rhmap {

template class OcTreeBaseImpl<ColorOcTreeNode, AbstractOccupancyOcTree>;
template class OccupancyOcTreeBase<ColorOcTreeNode>;

// --- the node ---

auto ColorOcTreeNode::getAverageChildColor() const -> Color {
  const NodeChildren all = childrenOf(this);
  std::array<int, 3> sum{};
  int count = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const auto* child = static_cast<const ColorOcTreeNode*>(all[i]);
    if (child == nullptr || !child->isColorSet()) continue;
    sum[0] += child->color.r;
    sum[1] += child->color.g;
    sum[2] += child->color.b;
    ++count;
  }
  if (count == 0) return {};
  const auto mean = [&](std::size_t i) { return static_cast<std::uint8_t>(sum[i] / count); };
  return {mean(0), mean(1), mean(2)};
}

void ColorOcTreeNode::toBytes(char* to) const {
  OcTreeNode::toBytes(to);
  const std::array<std::uint8_t, 3> rgb{color.r, color.g, color.b};
  std::memcpy(to + OcTreeNode::kDataBytes, rgb.data(), rgb.size());
}

void ColorOcTreeNode::fromBytes(const char* from) {
  OcTreeNode::fromBytes(from);
  std::array<std::uint8_t, 3> rgb;
  std::memcpy(rgb.data(), from + OcTreeNode::kDataBytes, rgb.size());
  color = {rgb[0], rgb[1], rgb[2]};
}

std::istream& ColorOcTreeNode::readData(std::istream& s) {
  std::array<char, kDataBytes> bytes;
  if (s.read(bytes.data(), bytes.size())) fromBytes(bytes.data());
  return s;
}

std::ostream& ColorOcTreeNode::writeData(std::ostream& s) const {
  std::array<char, kDataBytes> bytes;
  toBytes(bytes.data());
  return s.write(bytes.data(), bytes.size());
}

std::ostream& operator<<(std::ostream& out, const ColorOcTreeNode::Color& c) {
  return out << '(' << int{c.r} << ' ' << int{c.g} << ' ' << int{c.b} << ')';
}

// --- pruning ---

bool ColorOcTree::isNodeCollapsible(const ColorOcTreeNode* node) const {
  const NodeRef at = store_->locate(node);
  const NodeRef octet = at ? store_->childOctetOf(at) : NodeRef();
  if (!octet || octet.block->mask[static_cast<std::size_t>(octet.slot)] != 0xff) return false;
  const ColorOcTreeNode* children = store_->octet(octet.block, octet.slot).nodes;
  for (int i = 1; i < 8; ++i)
    if (!(children[i].getValue() == children[0].getValue())) return false;
  return !store_->anyHasChildren(octet);
}

bool ColorOcTree::pruneNode(ColorOcTreeNode* node) {
  if (!isNodeCollapsible(node)) return false;
  const Color mean = node->getAverageChildColor();
  node->copyData(*getNodeChild(node, 0));
  // OctoMap leaves the colour alone if the first child has none.
  if (node->isColorSet()) node->setColor(mean);
  structure::removeBelow(*store_, store_->locate(node));
  return true;
}

// --- colours ---

ColorOcTreeNode* ColorOcTree::setNodeColor(const OcTreeKey& key, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  ColorOcTreeNode* node = search(key);
  if (node != nullptr) node->setColor(r, g, b);
  return node;
}

ColorOcTreeNode* ColorOcTree::averageNodeColor(const OcTreeKey& key, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  ColorOcTreeNode* node = search(key);
  if (node == nullptr) return nullptr;
  const auto mean = [](std::uint8_t old, std::uint8_t now) { return static_cast<std::uint8_t>((old + now) / 2); };
  const Color old = node->getColor();
  node->setColor(node->isColorSet() ? Color(mean(old.r, r), mean(old.g, g), mean(old.b, b)) : Color(r, g, b));
  return node;
}

ColorOcTreeNode* ColorOcTree::integrateNodeColor(const OcTreeKey& key, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  ColorOcTreeNode* node = search(key);
  if (node == nullptr) return nullptr;
  const double p = node->getOccupancy();
  const auto blend = [p](std::uint8_t old, std::uint8_t now) {
    return static_cast<std::uint8_t>(static_cast<double>(old) * p + static_cast<double>(now) * (0.99 - p));
  };
  const Color old = node->getColor();
  node->setColor(node->isColorSet() ? Color(blend(old.r, r), blend(old.g, g), blend(old.b, b)) : Color(r, g, b));
  return node;
}

ColorOcTreeNode* ColorOcTree::setNodeColor(float x, float y, float z, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  OcTreeKey key;
  return coordToKeyChecked(point3d(x, y, z), key) ? setNodeColor(key, r, g, b) : nullptr;
}

ColorOcTreeNode* ColorOcTree::averageNodeColor(float x, float y, float z, std::uint8_t r, std::uint8_t g,
                                               std::uint8_t b) {
  OcTreeKey key;
  return coordToKeyChecked(point3d(x, y, z), key) ? averageNodeColor(key, r, g, b) : nullptr;
}

ColorOcTreeNode* ColorOcTree::integrateNodeColor(float x, float y, float z, std::uint8_t r, std::uint8_t g,
                                                 std::uint8_t b) {
  OcTreeKey key;
  return coordToKeyChecked(point3d(x, y, z), key) ? integrateNodeColor(key, r, g, b) : nullptr;
}

void ColorOcTree::updateInnerOccupancy() {
  if (ColorOcTreeNode* top = getRoot()) updateInnerOccupancyRecurs(top, 0);
}

void ColorOcTree::updateInnerOccupancyRecurs(ColorOcTreeNode* node, unsigned depth) {
  const Octet<ColorOcTreeNode> children = childrenOf(node);
  if (children.mask == 0) return;
  for (unsigned i = 0; i < 8; ++i)
    if (children.has(i)) updateInnerOccupancyRecurs(children.nodes + i, depth + 1);
  node->updateOccupancyChildren(children);
  node->updateColorChildren();
}

// --- the histogram ---

namespace {

struct Channel {
  char name;
  std::array<int, 256> counts{};
};

/// OctoMap's plot: the three channels as filled curves, and their outlines on top.
void writeGnuplot(std::ostream& s, const std::array<Channel, 3>& channels, const std::string& picture) {
  s << "set term postscript eps enhanced color\nset output \"" << picture << "\"\nplot [-1:256] ";
  for (int i = 0; i < 3; ++i)
    s << "'-' w filledcurve lt 1 lc " << i + 1 << " tit \"" << channels[static_cast<std::size_t>(i)].name << "\",";
  for (int i = 0; i < 3; ++i) s << "'-' w l lt 1 lc " << i + 1 << (i < 2 ? " tit \"\"," : " tit \"\"\n");
  for (int pass = 0; pass < 2; ++pass)
    for (const Channel& channel : channels) {
      for (int i = 0; i < 256; ++i) s << i << ' ' << channel.counts[static_cast<std::size_t>(i)] << '\n';
      if (pass == 0) s << "0 0\n";
      s << "e\n";
    }
}

}  // namespace

void ColorOcTree::writeColorHistogram(const std::string& filename) const {
  std::array<Channel, 3> channels{Channel{'r'}, Channel{'g'}, Channel{'b'}};
  for (auto it = begin_leafs(), last = end_leafs(); it != last; ++it) {
    if (!isNodeOccupied(*it)) continue;
    const Color color = std::as_const(*it).getColor();
    ++channels[0].counts[color.r];
    ++channels[1].counts[color.g];
    ++channels[2].counts[color.b];
  }
  std::string folder = (std::filesystem::temp_directory_path() / "rhmap_gnuplot_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error(folder + ": this folder cannot be made");
  const std::string script = folder + "/histogram.gnuplot";
  writeFileWhole(script, [&](std::ostream& s) { writeGnuplot(s, channels, filename); });
  const int status = std::system(("gnuplot '" + script + "' >/dev/null 2>&1").c_str());
  std::filesystem::remove_all(folder);
  if (status != 0) throw std::runtime_error(filename + ": gnuplot did not draw it; is it installed?");
}

}  // namespace rhmap
