// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "rhmap/octree/occupancy_octree_base.hpp"

namespace rhmap {

/// An occupancy node with a colour. White stands for "no colour yet".
class ColorOcTreeNode : public OcTreeNode {
 public:
  struct Color {
    std::uint8_t r = 255, g = 255, b = 255;

    Color() = default;
    Color(std::uint8_t red, std::uint8_t green, std::uint8_t blue) : r(red), g(green), b(blue) {}
    bool operator==(const Color&) const = default;
  };

  bool operator==(const ColorOcTreeNode& other) const { return value == other.value && color == other.color; }
  void copyData(const ColorOcTreeNode& from) {
    OcTreeNode::copyData(from);
    color = from.color;
  }

  Color getColor() const { return color; }
  Color& getColor() { return color; }
  void setColor(Color c) { color = c; }
  void setColor(std::uint8_t r, std::uint8_t g, std::uint8_t b) { color = {r, g, b}; }
  bool isColorSet() const { return color != Color(); }

  /// Mean of the children's colours, those without a colour left out; white if none has one.
  Color getAverageChildColor() const;
  /// Takes the mean colour of the children.
  void updateColorChildren() { color = getAverageChildColor(); }

  /// In .ot files: the log-odds, then red, green and blue.
  static constexpr std::size_t kDataBytes = OcTreeNode::kDataBytes + 3;
  void toBytes(char* to) const;
  void fromBytes(const char* from);
  std::istream& readData(std::istream& s);
  std::ostream& writeData(std::ostream& s) const;

 protected:
  Color color;
};

/// "(r g b)".
std::ostream& operator<<(std::ostream& out, const ColorOcTreeNode::Color& c);

extern template class OcTreeBaseImpl<ColorOcTreeNode, AbstractOccupancyOcTree>;
extern template class OccupancyOcTreeBase<ColorOcTreeNode>;

/// An occupancy map with colours: octomap::ColorOcTree's names and answers. Eight leaves of equal occupancy are pruned
/// whatever their colours, and the node that stays gets their mean colour.
class ColorOcTree : public OccupancyOcTreeBase<ColorOcTreeNode> {
 public:
  using Color = ColorOcTreeNode::Color;

  /// An empty map with cells of this edge length [m].
  ColorOcTree(double resolution) : OccupancyOcTreeBase(resolution) {}  // NOLINT: implicit, as OctoMap's is

  ColorOcTree* create() const override { return new ColorOcTree(getResolution()); }
  std::string getTreeType() const override { return "ColorOcTree"; }

  bool pruneNode(ColorOcTreeNode* node) override;
  bool isNodeCollapsible(const ColorOcTreeNode* node) const override;

  // The colour of a node that exists already; null, and nothing done, where it does not. A pruned leaf is coloured as a
  // whole. Coordinates in metres.

  /// Replaces the colour.
  ColorOcTreeNode* setNodeColor(const OcTreeKey& key, std::uint8_t r, std::uint8_t g, std::uint8_t b);
  ColorOcTreeNode* setNodeColor(float x, float y, float z, std::uint8_t r, std::uint8_t g, std::uint8_t b);
  /// The mean of the old colour, if there is one, and the new one.
  ColorOcTreeNode* averageNodeColor(const OcTreeKey& key, std::uint8_t r, std::uint8_t g, std::uint8_t b);
  ColorOcTreeNode* averageNodeColor(float x, float y, float z, std::uint8_t r, std::uint8_t g, std::uint8_t b);
  /// The old colour, if there is one, weighed by the node's occupancy p, the new one by 0.99 - p.
  ColorOcTreeNode* integrateNodeColor(const OcTreeKey& key, std::uint8_t r, std::uint8_t g, std::uint8_t b);
  ColorOcTreeNode* integrateNodeColor(float x, float y, float z, std::uint8_t r, std::uint8_t g, std::uint8_t b);

  /// Recomputes occupancy and colour of all inner nodes from their children, without pruning.
  void updateInnerOccupancy();

  /// Draws histograms of the three colour channels over the occupied leaves into a PostScript file, by the program
  /// gnuplot. Throws std::runtime_error if that fails.
  void writeColorHistogram(const std::string& filename) const;

 protected:
  void updateInnerOccupancyRecurs(ColorOcTreeNode* node, unsigned depth);
};

}  // namespace rhmap
