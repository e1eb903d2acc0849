// SPDX-License-Identifier: BSD-3-Clause
// getUnknownLeafCenters, getNormals and getRayIntersection on rhmap and on stock OctoMap: the same floats, bit by bit.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "../clip.hpp"
#include "oracle.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// The bits of all coordinates; the many NaNs are one.
template <class Points>
std::vector<std::uint32_t> bitsOf(const Points& points) {
  std::vector<std::uint32_t> bits;
  for (const point3d& p : points)
    for (unsigned i = 0; i < 3; ++i)
      bits.push_back(std::isnan(p(i)) ? 0x7fc00000U : std::bit_cast<std::uint32_t>(p(i)));
  return bits;
}

/// The same map twice.
struct Maps {
  explicit Maps(double resolution) : ours(resolution), theirs(resolution) {}

  template <class F>
  void both(F&& change) {
    change(ours);
    change(theirs);
  }

  OcTree ours;
  test::OctomapOracle theirs;
};

void expectSameNormals(const Maps& maps, const point3d& p) {
  for (const bool unknown : {true, false}) {
    std::vector<point3d> ours(3), theirs(3);  // something to be cleared
    ASSERT_EQ(maps.ours.getNormals(p, ours, unknown), maps.theirs.getNormals(p, theirs, unknown)) << p;
    ASSERT_EQ(bitsOf(ours), bitsOf(theirs)) << p << (unknown ? ", unknown is occupied" : ", unknown is free");
  }
}

/// Which it may be because its corners are outside of the tree and wrap around.
bool isInsideOut(const Maps& maps, const point3d& min, const point3d& max, unsigned depth) {
  if (depth == 0) depth = 16;
  const auto snapped = [&](float x) { return maps.theirs.keyToCoord(maps.theirs.coordToKey(double(x), depth), depth); };
  return snapped(max.x()) < snapped(min.x()) || snapped(max.y()) < snapped(min.y()) ||
         snapped(max.z()) < snapped(min.z());
}

/// How many there are.
std::size_t expectSameUnknown(const Maps& maps, const point3d& min, const point3d& max, unsigned depth) {
  octomap::point3d_list ours{{1, 2, 3}}, theirs{{1, 2, 3}};  // something to be kept
  maps.ours.getUnknownLeafCenters(ours, min, max, depth);
  // This would take OctoMap 2^32 steps along an axis, and as many points.
  if (isInsideOut(maps, min, max, depth)) {
    EXPECT_EQ(ours.size(), 1U);
    return 0;
  }
  maps.theirs.getUnknownLeafCenters(theirs, min, max, depth);
  EXPECT_EQ(bitsOf(ours), bitsOf(theirs)) << min << " to " << max << " at depth " << depth;
  return ours.size() - 1;
}

bool expectSameIntersection(const Maps& maps, const point3d& origin, const point3d& direction, const point3d& centre,
                            double delta) {
  point3d ours(7, 8, 9), theirs(7, 8, 9);  // something to be left alone
  const bool met = maps.ours.getRayIntersection(origin, direction, centre, ours, delta);
  EXPECT_EQ(met, maps.theirs.getRayIntersection(origin, direction, centre, theirs, delta))
      << origin << " along " << direction << " to " << centre;
  EXPECT_EQ(bitsOf(std::vector{ours}), bitsOf(std::vector{theirs}))
      << origin << " along " << direction << " to " << centre << " + " << delta;
  return met;
}

class SurfaceQueries : public testing::TestWithParam<unsigned> {
 protected:
  SurfaceQueries() : random_(GetParam()), maps_(GetParam() % 3 == 0 ? 0.05 : GetParam() % 3 == 1 ? 0.1 : 0.37) {
    const unsigned place = GetParam() % 4;
    if (place == 1) base_ = OcTreeKey(65529, 65531, 65530);  // keys wrap around to the other side of the tree
    if (place == 2) base_ = OcTreeKey(40000, 1000, 32760);
    if (place == 3) base_ = OcTreeKey(0, 65535 - 12, 32768);
  }

  int below(int n) { return std::uniform_int_distribution(0, n - 1)(random_); }
  double real(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  OcTreeKey key(int extent = 12) {
    OcTreeKey k;
    for (unsigned i = 0; i < 3; ++i) k[i] = static_cast<key_type>(base_[i] + below(extent));
    return k;
  }
  point3d point() {
    point3d p = maps_.ours.keyToCoord(key());
    for (unsigned i = 0; i < 3; ++i) p(i) += static_cast<float>(real(-0.7, 0.7) * maps_.ours.getResolution());
    return p;
  }

  /// Single cells, and blocks that are pruned.
  void fill() {
    for (int i = 0; i < 400; ++i) {
      const OcTreeKey k = key();
      const bool occupied = below(2) == 0;
      maps_.both([&](auto& map) { map.updateNode(k, occupied); });
    }
    for (int i = 0; i < 8; ++i) {
      const OcTreeKey corner = key(8);
      const int edge = 1 << below(4);
      const bool occupied = below(2) == 0;
      for (int n = 0; n < edge * edge * edge; ++n) {
        OcTreeKey k = corner;
        for (unsigned axis = 0, m = static_cast<unsigned>(n); axis < 3; ++axis, m /= static_cast<unsigned>(edge))
          k[axis] = static_cast<key_type>((k[axis] & ~(edge - 1)) + static_cast<int>(m % static_cast<unsigned>(edge)));
        maps_.both([&](auto& map) { map.setNodeValue(k, occupied ? 2.0F : -1.0F); });
      }
    }
    ASSERT_TRUE(test::otBytes(maps_.ours) == test::otBytes(maps_.theirs));
  }

  std::mt19937 random_;
  Maps maps_;
  OcTreeKey base_{32760, 32765, 32750};
};

TEST_P(SurfaceQueries, NormalsAreOctomaps) {
  fill();
  std::size_t some = 0;
  for (int i = 0; i < 1500; ++i) {
    const point3d p = point();
    ASSERT_NO_FATAL_FAILURE(expectSameNormals(maps_, p));
    std::vector<point3d> normals;
    maps_.ours.getNormals(p, normals);
    some += !normals.empty();
  }
  EXPECT_GT(some, 100U);
}

TEST_P(SurfaceQueries, UnknownCentresAreOctomaps) {
  fill();
  std::size_t found = 0;
  for (int i = 0; i < 600; ++i) {
    const unsigned depth = static_cast<unsigned>(i % 17);
    const auto node = static_cast<float>(maps_.ours.getNodeSize(depth == 0 ? 16 : depth));
    point3d min = point(), max = min;
    if (below(2) == 0) min -= point3d(node, node, node) * 2.0F;
    max +=
        point3d(static_cast<float>(real(0, 9)), static_cast<float>(real(0, 9)), static_cast<float>(real(0, 9))) * node;
    found += expectSameUnknown(maps_, min, max, depth);
  }
  EXPECT_GT(found, 1000U);
}

TEST_P(SurfaceQueries, IntersectionsAreOctomaps) {
  const auto size = static_cast<float>(maps_.ours.getResolution());
  std::size_t met = 0, missed = 0;
  for (int i = 0; i < 20000; ++i) {
    const point3d centre = maps_.ours.keyToCoord(key());
    const point3d origin = below(6) == 0 ? centre : point();
    point3d direction = centre - origin;  // to its middle or beside it, or anywhere
    for (unsigned axis = 0; axis < 3; ++axis) {
      direction(axis) += static_cast<float>(real(-1.2, 1.2)) * size;
      if (below(5) == 0) direction(axis) = 0;
      if (below(8) == 0) direction(axis) = -direction(axis);
    }
    if (below(2) == 0) direction.normalize();
    const double delta = below(2) == 0 ? 0.0 : real(-0.2, 0.2);
    (expectSameIntersection(maps_, origin, direction, centre, delta) ? met : missed) += 1;
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(met, 1000U);
  EXPECT_GT(missed, 1000U);
}

TEST_P(SurfaceQueries, IntersectionsOnEdgesAndFacesAreOctomaps) {
  const double r = maps_.ours.getResolution();
  const point3d centre = maps_.ours.keyToCoord(OcTreeKey(32768, 32769, 32767));
  const float steps[] = {-1.5F, -0.5F, 0.0F, 0.5F, 1.5F};
  const float ends[] = {-1.0F, -0.0F, 0.0F, 0.5F, 1.0F};
  const auto offset = [&](const float* of, int n) {
    return point3d(of[n % 5], of[n / 5 % 5], of[n / 25]) * static_cast<float>(r);
  };
  for (int from = 0; from < 125; ++from)
    for (int to = 0; to < 125; ++to) {
      expectSameIntersection(maps_, centre + offset(steps, from), offset(ends, to), centre, 0.0);
      ASSERT_FALSE(HasFailure());
    }
}

TEST_P(SurfaceQueries, AnswerLikeOctomapToWhatIsNoNumber) {
  fill();
  const float values[] = {kNan, kInf, -kInf, 1e30F, -1e30F, 3e38F, 0.0F, 1.0F};
  const auto any = [&] { return values[below(8)]; };
  for (int i = 0; i < 3000; ++i) {
    const point3d a(any(), any(), any()), b(any(), any(), any());
    ASSERT_NO_FATAL_FAILURE(expectSameNormals(maps_, a));
    expectSameIntersection(maps_, a, b, point(), 0.1);
    expectSameIntersection(maps_, point(), a, b, 0.0);
    expectSameIntersection(maps_, point(), b, point(), i % 2 == 0 ? double(kNan) : 1e300);
    ASSERT_FALSE(HasFailure());
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, SurfaceQueries, testing::Range(0U, 12U));

TEST(UnknownCentres, OfABoxThatIsNoBoxAreOctomaps) {
  Maps maps(0.1);
  maps.both([](auto& map) { map.updateNode(0.05, 0.05, 0.05, true); });
  for (const float far : {kNan, kInf, 1e30F, 3e38F, 3e9F})
    for (unsigned depth = 0; depth <= 16; ++depth) {
      expectSameUnknown(maps, {-far, -far, -far}, {far, far, far}, depth);
      expectSameUnknown(maps, {far, far, far}, {-far, -far, -far}, depth);
      expectSameUnknown(maps, {far, 0, 0}, {0, 0, 0}, depth);
      expectSameUnknown(maps, {far, 0, 0}, {0.55F, 0.55F, far}, depth);
    }
}

TEST(UnknownCentres, OfAnInvertedBoxAreNone) {
  OcTree map(0.1);
  octomap::point3d_list centres;
  map.getUnknownLeafCenters(centres, {1, 1, 1}, {-1, 2, 2});
  map.getUnknownLeafCenters(centres, {1, 1, 1}, {2, -2, 2}, 3);
  map.getUnknownLeafCenters(centres, {1, 1, 1}, {2, 2, -2}, 15);
  EXPECT_TRUE(centres.empty());
}

TEST(UnknownCentres, OfTheWholeTreeAreTooManyToListButNotAtUpperDepths) {
  Maps maps(0.1);
  maps.both([](auto& map) { map.updateNode(0.05, 0.05, 0.05, true); });
  octomap::point3d_list centres{{0, 0, 0}};
  EXPECT_THROW(maps.ours.getUnknownLeafCenters(centres, {-3276, -3276, -3276}, {3276, 3276, 3276}), std::length_error);
  EXPECT_EQ(centres.size(), 1U);
  for (unsigned depth = 1; depth <= 6; ++depth)
    expectSameUnknown(maps, {-3276, -3276, -3276}, {3276, 3276, 3276}, depth);
}

TEST(UnknownCentres, BelowADepthOf16AreThoseOfCells) {
  OcTree map(0.1);
  octomap::point3d_list cells, deeper;
  map.getUnknownLeafCenters(cells, {0, 0, 0}, {1, 1, 1});
  map.getUnknownLeafCenters(deeper, {0, 0, 0}, {1, 1, 1}, 17);
  EXPECT_EQ(bitsOf(cells), bitsOf(deeper));
}

TEST(UnknownCentres, WanderInFloatAsOctomapsDo) {
  for (const double resolution : {0.05, 0.1, 0.2}) {
    Maps maps(resolution);
    maps.both([](auto& map) { map.updateNode(0.05, 0.05, 0.05, true); });
    const auto r = static_cast<float>(resolution);
    const point3d start(30000 * r, 100 * r, -32000 * r);
    expectSameUnknown(maps, start, start + point3d(2700 * r, 3 * r, 3 * r), 0);
    expectSameUnknown(maps, start, start + point3d(3 * r, 31000 * r, 3 * r), 16);
    expectSameUnknown(maps, start, start + point3d(9 * r, 9 * r, 60000 * r), 15);
  }
}

/// Queries all over a map: on its leaves, beside them, anywhere in its bounds.
void expectSameOn(const Maps& maps, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<OcTreeKey> leaves;
  for (auto it = maps.ours.begin_leafs(); it != maps.ours.end_leafs(); ++it)
    if (random() % 50 == 0) leaves.push_back(it.getKey());
  ASSERT_FALSE(leaves.empty());
  const auto r = static_cast<float>(maps.ours.getResolution());
  std::uniform_real_distribution<float> near(-3 * r, 3 * r);
  const auto somewhere = [&] {
    return maps.ours.keyToCoord(leaves[random() % leaves.size()]) + point3d(near(random), near(random), near(random));
  };
  std::size_t normals = 0, entered = 0;
  for (int i = 0; i < 4000; ++i) {
    const point3d p = somewhere();
    ASSERT_NO_FATAL_FAILURE(expectSameNormals(maps, p));
    std::vector<point3d> found;
    normals += maps.ours.getNormals(p, found, false) && !found.empty();
    // What getRayIntersection is for: the point where castRay's ray meets the cell that it ends in.
    const point3d origin = somewhere();
    point3d end;
    if (maps.ours.castRay(origin, p - origin, end, true, 20.0))
      entered += expectSameIntersection(maps, origin, (p - origin).normalized(), end, 0.0);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
  for (int i = 0; i < 340; ++i) {
    const unsigned depth = static_cast<unsigned>(i % 17);
    const auto node = static_cast<float>(maps.ours.getNodeSize(depth == 0 ? 16 : depth));
    const point3d p = somewhere();
    expectSameUnknown(maps, p, p + point3d(4, 7, 11) * node, depth);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
  EXPECT_GT(normals, 500U);
  EXPECT_GT(entered, 300U);
}

TEST(SurfaceQueriesOnRealData, AreOctomapsOnAMapFile) {
  Maps maps(0.1);
  maps.both([](auto& map) { ASSERT_TRUE(map.readBinary(RHMAP_DATA_DIR "/maps/geb079.bt")); });
  expectSameOn(maps, 1);
}

TEST(SurfaceQueriesOnRealData, AreOctomapsOnScans) {
  const auto clip = io::openSequence(test::clipFolder());
  const auto graph = io::openSequence(std::string(RHMAP_DATA_DIR) + "/maps/spherical_scan.graph");
  for (const auto* sequence : {clip.get(), graph.get()}) {
    Maps maps(0.2);
    const io::Scan scan = sequence->scan(0);
    octomap::Pointcloud points = scan.points;
    points.transform(scan.pose);
    maps.both([&](auto& map) { map.insertPointCloud(points, scan.pose.trans(), 30.0); });
    expectSameOn(maps, 2);
  }
}

}  // namespace
}  // namespace rhmap
