// SPDX-License-Identifier: BSD-3-Clause
// Scans of a sphere, and rays into it.
#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <cmath>

namespace {

using octomap::KeyRay;
using octomap::KeySet;
using octomap::OcTree;
using octomap::point3d;
using octomap::Pointcloud;

const point3d kCentre(0.03F, -0.02F, 0.05F);

/// Directions spread over the sphere, by the golden angle.
std::vector<point3d> directions(int n) {
  std::vector<point3d> all;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z), a = 2.399963229728653 * i;
    all.push_back(point3d(float(r * std::cos(a)), float(r * std::sin(a)), float(z)));
  }
  return all;
}

OcTree sphere(float radius, int n) {
  Pointcloud points;
  for (const point3d& d : directions(n)) points.push_back(kCentre + d * radius);
  OcTree tree(0.05);
  tree.insertPointCloud(points, kCentre);
  return tree;
}

struct Counts {
  int hits = 0, free = 0, unknown = 0;
  bool operator==(const Counts&) const = default;
};
std::ostream& operator<<(std::ostream& s, const Counts& c) {
  return s << c.hits << " hits, " << c.free << " ended in free space, " << c.unknown << " in unknown space";
}

/// What becomes of rays from the centre.
Counts castFromCentre(const OcTree& tree, int n, bool ignore_unknown, double range) {
  Counts counts;
  for (const point3d& d : directions(n)) {
    point3d end;
    if (tree.castRay(kCentre, d, end, ignore_unknown, range)) {
      ++counts.hits;
      EXPECT_TRUE(tree.isNodeOccupied(tree.search(end)));
    } else {
      ++(tree.search(end) == nullptr ? counts.unknown : counts.free);
    }
  }
  return counts;
}

TEST(Rays, HitTheSphereThatWasScanned) {
  const OcTree tree = sphere(2, 40000);
  EXPECT_EQ(castFromCentre(tree, 5000, false, -1), (Counts{.hits = 5000}));
  EXPECT_EQ(castFromCentre(tree, 5000, true, 3), (Counts{.hits = 5000}));
  EXPECT_EQ(castFromCentre(tree, 5000, false, 1), (Counts{.free = 5000}));
  EXPECT_EQ(tree.size(), 50429U);
}

TEST(Rays, PassBetweenTheCellsOfASparseSphere) {
  const OcTree tree = sphere(2, 2000);
  EXPECT_EQ(castFromCentre(tree, 5000, false, -1), (Counts{.hits = 1, .unknown = 4999}));
  EXPECT_EQ(castFromCentre(tree, 5000, true, 3), (Counts{.hits = 766, .unknown = 4234}));
}

TEST(Rays, HitEveryPointOfASparseSphere) {
  const OcTree tree = sphere(2, 2000);
  EXPECT_EQ(castFromCentre(tree, 2000, false, -1), (Counts{.hits = 2000}));
}

TEST(Rays, FromAnOccupiedCellEndThere) {
  OcTree tree = sphere(2, 2000);
  tree.updateNode(kCentre, 5.0F);
  point3d end;
  EXPECT_TRUE(tree.castRay(kCentre, point3d(1, 0, 0), end));
  EXPECT_EQ(end, tree.keyToCoord(tree.coordToKey(kCentre)));
}

TEST(Rays, KeysLeadFromTheOriginToBeforeTheEnd) {
  const OcTree tree(0.05);
  KeyRay ray;
  for (const point3d& d : directions(300)) {
    const point3d end = kCentre + d * 3;
    ASSERT_TRUE(tree.computeRayKeys(kCentre, end, ray));
    ASSERT_GT(ray.size(), 30U);
    EXPECT_EQ(*ray.begin(), tree.coordToKey(kCentre));
    EXPECT_EQ(std::find(ray.begin(), ray.end(), tree.coordToKey(end)), ray.end());
    int steps = 0;
    for (KeyRay::iterator it = ray.begin(), next = it; ++next != ray.end(); it = next)
      for (unsigned i = 0; i < 3; ++i) steps += std::abs(int((*it)[i]) - int((*next)[i]));
    EXPECT_EQ(steps + 1U, ray.size());  // one step along one axis each
  }
  EXPECT_TRUE(tree.computeRayKeys(kCentre, kCentre, ray));
  EXPECT_EQ(ray.size(), 0U);
  EXPECT_FALSE(tree.computeRayKeys(kCentre, point3d(1e6F, 0, 0), ray));
}

TEST(Rays, OfOneScanUpdateEachCellOnce) {
  Pointcloud points;
  for (const point3d& d : directions(3000)) points.push_back(kCentre + d * 2);
  OcTree tree(0.05), by_hand(0.05), by_rays(0.05);
  tree.insertPointCloud(points, kCentre);
  KeySet free, occupied;
  by_hand.computeUpdate(points, kCentre, free, occupied, -1);
  for (KeySet::iterator it = free.begin(); it != free.end(); ++it) {
    EXPECT_EQ(occupied.count(*it), 0U);
    by_hand.updateNode(*it, false);
  }
  for (KeySet::iterator it = occupied.begin(); it != occupied.end(); ++it) by_hand.updateNode(*it, true);
  EXPECT_TRUE(tree == by_hand);
  by_rays.insertPointCloudRays(points, kCentre);
  EXPECT_FALSE(tree == by_rays);
  EXPECT_EQ(tree.search(kCentre)->getLogOdds(), tree.getProbMissLog());
  EXPECT_EQ(by_rays.search(kCentre)->getLogOdds(), by_rays.getClampingThresMinLog());
}

TEST(Rays, AreCutAtTheRange) {
  OcTree tree(0.05);
  EXPECT_TRUE(tree.insertRay(kCentre, kCentre + point3d(2, 0, 0), 1.0));
  EXPECT_NE(tree.search(kCentre + point3d(0.9F, 0, 0)), nullptr);
  EXPECT_EQ(tree.search(kCentre + point3d(1.1F, 0, 0)), nullptr);
  EXPECT_TRUE(tree.insertRay(kCentre, kCentre + point3d(0, 2, 0), 3.0));
  EXPECT_TRUE(tree.isNodeOccupied(tree.search(kCentre + point3d(0, 2, 0))));
}

}  // namespace
