// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/render/face_mesh.hpp"

#include <gtest/gtest.h>

#include <random>

#include "rhmap/octree/octree.hpp"

namespace rhmap::render {
namespace {

constexpr key_type kMid = kTreeMaxVal;

FaceMesh facesOf(const OcTree& tree) {
  return occupiedFaces(tree, [](const auto&) { return Colour{}; });
}

void occupy(OcTree& tree, int x, int y, int z) {
  tree.setNodeValue(OcTreeKey(key_type(kMid + x), key_type(kMid + y), key_type(kMid + z)), 2.F);
}

/// Sides of cells, in units of one cell.
std::size_t area(const FaceMesh& mesh) {
  std::size_t sum = 0;
  for (const Face& face : mesh.faces) sum += std::size_t{1} << 2 * face.edge_log2;
  return sum;
}

TEST(FaceMesh, ACellHasSixFaces) {
  OcTree tree(0.5);
  occupy(tree, 0, 0, 0);
  const FaceMesh mesh = facesOf(tree);
  EXPECT_EQ(mesh.faces.size(), 6U);
  for (const Face& face : mesh.faces) EXPECT_EQ(face.corner_light, 0xff);  // nothing stands near
  const Box box = boundsOf(mesh);
  EXPECT_TRUE(box.min().isApproxToConstant(0));
  EXPECT_TRUE(box.max().isApproxToConstant(0.5));
}

TEST(FaceMesh, NeighboursHideTheSidesBetweenThem) {
  OcTree tree(0.5);
  occupy(tree, -1, 0, 0);
  occupy(tree, 0, 0, 0);
  EXPECT_EQ(facesOf(tree).faces.size(), 10U);
}

TEST(FaceMesh, APrunedCubeHasSixLargeFaces) {
  OcTree tree(0.5);
  for (int i = 0; i < 8; ++i) occupy(tree, i & 1, i >> 1 & 1, i >> 2);
  ASSERT_EQ(tree.getNumLeafNodes(), 1U);
  const FaceMesh mesh = facesOf(tree);
  EXPECT_EQ(mesh.faces.size(), 6U);
  EXPECT_EQ(area(mesh), 24U);
}

TEST(FaceMesh, ALargeFaceIsCutWhereACellStandsAgainstIt) {
  OcTree tree(0.5);
  for (int i = 0; i < 8; ++i) occupy(tree, i & 1, i >> 1 & 1, i >> 2);
  occupy(tree, 0, 0, 2);
  EXPECT_EQ(area(facesOf(tree)), 24U - 1 + 5);
}

TEST(FaceMesh, ALeafOfAnEighthOfTheWorldHasSixFaces) {
  OcTree tree(0.5);
  tree.updateNode(OcTreeKey(0, 0, 0), true);
  tree.createNodeChild(tree.getRoot(), 7)->setLogOdds(2.F);
  const FaceMesh mesh = facesOf(tree);
  EXPECT_EQ(mesh.faces.size(), 12U);  // those of the cell as well
  EXPECT_EQ(area(mesh), 6 * (std::size_t{1} << 30) + 6);
}

TEST(FaceMesh, FreeNeighboursHideNothing) {
  OcTree tree(0.5);
  occupy(tree, 0, 0, 0);
  tree.setNodeValue(OcTreeKey(kMid + 1, kMid, kMid), -2.F);
  EXPECT_EQ(facesOf(tree).faces.size(), 6U);
  EXPECT_EQ(freeFaces(tree).faces.size(), 6U);
}

TEST(FaceMesh, CornersUnderAStepAreDark) {
  OcTree tree(0.5);
  occupy(tree, 0, 0, 0);
  occupy(tree, 1, 0, 1);  // above the edge to its right
  for (const Face& face : facesOf(tree).faces) {
    if (face.side != 5 || face.corner[0] != kMid) continue;
    // The face's own axes are x and y: corners (1, 0) and (1, 1) touch the step.
    EXPECT_EQ(face.corner_light & 3, 3);
    EXPECT_EQ(face.corner_light >> 2 & 3, 2);
    EXPECT_EQ(face.corner_light >> 4 & 3, 2);
    EXPECT_EQ(face.corner_light >> 6, 3);
  }
}

TEST(FaceMesh, LeavesOutWhatIsAboveTheCeilingAndClosesTheCut) {
  OcTree tree(0.5);
  for (int z = 0; z < 4; ++z) occupy(tree, 0, 0, z);
  const FaceMesh mesh = occupiedFaces(
      tree, [](const auto&) { return Colour{}; }, 1.0);
  EXPECT_EQ(area(mesh), 10U);
  EXPECT_NEAR(boundsOf(mesh).max().z(), 1.0, 1e-12);
}

/// Looks at every cell and all its neighbours.
TEST(FaceMesh, CoversExactlyTheSidesThatABruteForceSearchFinds) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> coordinate(-9, 9);
  OcTree tree(0.1);
  for (int i = 0; i < 4000; ++i)
    tree.setNodeValue(OcTreeKey(key_type(kMid + coordinate(random)), key_type(kMid + coordinate(random)),
                                key_type(kMid + coordinate(random) / 3)),
                      i % 4 == 0 ? -2.F : 2.F);
  const auto occupied = [&](int x, int y, int z) {
    const auto* node = tree.search(OcTreeKey(key_type(kMid + x), key_type(kMid + y), key_type(kMid + z)));
    return node != nullptr && tree.isNodeOccupied(node);
  };
  std::size_t exposed = 0;
  for (int x = -10; x <= 10; ++x)
    for (int y = -10; y <= 10; ++y)
      for (int z = -10; z <= 10; ++z)
        if (occupied(x, y, z))
          exposed += std::size_t(!occupied(x - 1, y, z)) + !occupied(x + 1, y, z) + !occupied(x, y - 1, z) +
                     !occupied(x, y + 1, z) + !occupied(x, y, z - 1) + !occupied(x, y, z + 1);
  ASSERT_GT(exposed, 500U);
  EXPECT_EQ(area(facesOf(tree)), exposed);
}

}  // namespace
}  // namespace rhmap::render
