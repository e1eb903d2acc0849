// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "rhmap/core/region_cursor.hpp"
#include "rhmap/octree/key_space.hpp"
#include "rhmap/render/camera.hpp"
#include "rhmap/render/colour.hpp"

namespace rhmap::render {

/// One side of a cube of cells.
struct Face {
  OcTreeKey corner;           ///< smallest key of the cube
  std::uint8_t edge_log2;     ///< the cube is 2^edge_log2 cells wide
  std::uint8_t side;          ///< axis * 2, + 1 for the side where the axis is larger
  std::uint8_t corner_light;  ///< 2 bits a corner of the face, see kCornerSteps: 3 is open, 0 in a nook
  Colour colour;
};

/// The corners of a face in its own two axes (those after its axis, cyclically), in the order of `corner_light`.
inline constexpr std::array<std::array<int, 2>, 4> kCornerSteps{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// The outer sides of a set of leaves: what can be seen of them.
struct FaceMesh {
  double resolution = 0;  ///< edge of a cell [m]
  std::vector<Face> faces;
};

/// The box [m] around the cubes that the faces belong to; empty for none.
Box boundsOf(const FaceMesh& mesh);

/// Finds the exposed sides of leaves in a tree.
template <class TREE, class WANTED>
class FaceFinder {
 public:
  using Node = typename TREE::NodeType;

  /// `wanted(node, key)` says whether a leaf, or what of it is at the key, is solid; a side is exposed where what is
  /// beyond it is not.
  FaceFinder(const TREE& tree, WANTED wanted) : tree_(tree), wanted_(wanted), cursor_(tree.store()) {}

  void append(const OcTreeKey& corner, unsigned depth, Colour colour, FaceMesh& mesh) {
    for (unsigned side = 0; side < 6; ++side)
      appendSide({corner, edgeLog2(depth), std::uint8_t(side), 0, colour}, mesh);
  }

 private:
  static std::uint8_t edgeLog2(unsigned depth) { return static_cast<std::uint8_t>(kTreeDepth - depth); }

  /// The whole side, or the parts of it that are exposed: as fine as what stands against it.
  void appendSide(Face face, FaceMesh& mesh) {
    const unsigned axis = face.side / 2;
    const int width = 1 << face.edge_log2;
    const int beyond = int(face.corner[axis]) + (face.side % 2 == 1 ? width : -width);
    if (beyond >= 0 && beyond <= 0xffff) {
      OcTreeKey key = face.corner;
      key[axis] = static_cast<key_type>(beyond);
      const Node* node = face.edge_log2 == 0 ? cursor_.search(key) : tree_.search(key, kTreeDepth - face.edge_log2);
      if (node != nullptr && face.edge_log2 > 0 && tree_.nodeHasChildren(node)) return appendQuarters(face, mesh);
      if (node != nullptr && wanted_(*node, key)) return;
    }
    face.corner_light = cornerLight(face);
    mesh.faces.push_back(face);
  }

  void appendQuarters(const Face& face, FaceMesh& mesh) {
    const unsigned axis = face.side / 2;
    const auto half = static_cast<key_type>(1U << (face.edge_log2 - 1));
    for (const auto& step : kCornerSteps) {
      Face quarter = face;
      quarter.edge_log2 = static_cast<std::uint8_t>(face.edge_log2 - 1);
      if (face.side % 2 == 1) quarter.corner[axis] = static_cast<key_type>(quarter.corner[axis] + half);
      for (unsigned i = 0; i < 2; ++i) {
        key_type& key = quarter.corner[(axis + 1 + i) % 3];
        key = static_cast<key_type>(key + step[i] * half);
      }
      appendSide(quarter, mesh);
    }
  }

  /// How open each corner is: what stands in the layer beyond the face and touches the corner takes light from it.
  std::uint8_t cornerLight(const Face& face) {
    const unsigned axis = face.side / 2;
    const int width = 1 << face.edge_log2;
    std::array<int, 3> at{face.corner[0], face.corner[1], face.corner[2]};
    at[axis] += face.side % 2 == 1 ? width : -1;
    const unsigned u = (axis + 1) % 3, v = (axis + 2) % 3;
    unsigned light = 0;
    for (unsigned i = 0; i < 4; ++i) {
      const auto inside = [&](unsigned a, int step) { return at[a] + (step == 1 ? width - 1 : 0); };
      const auto outside = [&](unsigned a, int step) { return at[a] + (step == 1 ? width : -1); };
      const auto stands = [&](int at_u, int at_v) {
        std::array<int, 3> place = at;
        place[u] = at_u;
        place[v] = at_v;
        return isSolid(place);
      };
      const auto [step_u, step_v] = kCornerSteps[i];
      const bool beside_u = stands(outside(u, step_u), inside(v, step_v));
      const bool beside_v = stands(inside(u, step_u), outside(v, step_v));
      const bool across = stands(outside(u, step_u), outside(v, step_v));
      light |= (beside_u && beside_v ? 0U : 3U - (beside_u + beside_v + across)) << 2 * i;
    }
    return static_cast<std::uint8_t>(light);
  }

  bool isSolid(const std::array<int, 3>& place) {
    for (const int k : place)
      if (k < 0 || k > 0xffff) return false;
    const OcTreeKey key(static_cast<key_type>(place[0]), static_cast<key_type>(place[1]),
                        static_cast<key_type>(place[2]));
    const Node* node = cursor_.search(key);
    return node != nullptr && wanted_(*node, key);
  }

  const TREE& tree_;
  WANTED wanted_;
  RegionCursor<Node> cursor_;
};

/// The exposed faces of the leaves that are `wanted(node, smallest key)`, each in the colour `colour_of(leaf
/// iterator)`.
template <class TREE, class WANTED, class COLOUR>
FaceMesh exposedFaces(const TREE& tree, WANTED wanted, COLOUR colour_of) {
  FaceMesh mesh{.resolution = tree.getResolution(), .faces = {}};
  FaceFinder<TREE, WANTED> finder(tree, wanted);
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf)
    if (wanted(*leaf, leaf.getIndexKey())) finder.append(leaf.getIndexKey(), leaf.getDepth(), colour_of(leaf), mesh);
  return mesh;
}

/// The map's obstacles: the exposed faces of all occupied leaves that begin below `ceiling` [m].
template <class TREE, class COLOUR>
FaceMesh occupiedFaces(const TREE& tree, COLOUR colour_of, double ceiling = std::numeric_limits<double>::infinity()) {
  const double first_above = std::ceil(ceiling / tree.getResolution()) + double(kTreeMaxVal);
  return exposedFaces(
      tree,
      [&tree, first_above](const typename TREE::NodeType& node, const OcTreeKey& key) {
        return tree.isNodeOccupied(node) && key[2] < first_above;
      },
      colour_of);
}

/// The hull of the free space, in one colour.
template <class TREE>
FaceMesh freeFaces(const TREE& tree, Colour colour = kFreeSpace) {
  return exposedFaces(
      tree, [&tree](const typename TREE::NodeType& node, const OcTreeKey&) { return !tree.isNodeOccupied(node); },
      [colour](const auto&) { return colour; });
}

}  // namespace rhmap::render
