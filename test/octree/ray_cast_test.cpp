// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/ray_cast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "oracle.hpp"
#include "rhmap/octree/octree.hpp"
#include "rhmap/octree/ray_steps.hpp"
#include "targets.hpp"

namespace rhmap {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Along axes and diagonals (ties), nearly so, and anywhere.
std::vector<point3d> directions(std::mt19937& random) {
  std::vector<point3d> all;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const point3d d(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        all.push_back(d);
        all.push_back(d + point3d(1e-6F, -1e-7F, 1e-5F));
        all.push_back(point3d(d.x() * 1e-30F, d.y(), d.z() * 3));
        all.push_back(d * 1e-30F);  // too short for a unit vector: its squares are 0
      }
  std::normal_distribution<float> normal;
  for (int i = 0; i < 300; ++i) all.emplace_back(normal(random), normal(random), normal(random));
  return all;
}

/// Cells in the middle of the key space, and few steps from its border.
std::vector<OcTreeKey> startKeys(std::mt19937& random) {
  std::vector<OcTreeKey> all{{32768, 32768, 32768}, {32767, 32768, 40000}, {0, 65535, 3}, {65535, 65535, 65535}};
  for (int i = 0; i < 20; ++i) {
    OcTreeKey key;
    for (unsigned axis = 0; axis < 3; ++axis)
      key[axis] = static_cast<key_type>(random() % 3 == 0 ? random() % 12 - 6 : 30000 + random() % 5000);
    all.push_back(key);
  }
  return all;
}

/// Calls `check` for difficult rays, which start from the middle of a cell, its corner or anywhere in it.
template <class Check>
void forEachRay(Check&& check) {
  std::mt19937 random(11);
  const KeySpace keys(0.1);
  for (const OcTreeKey& key : startKeys(random))
    for (const point3d& direction : directions(random)) {
      point3d origin = keys.keyToCoord(key);
      const auto kind = random() % 3;
      const auto offset = [&] {
        return kind == 0 ? 0.0F : kind == 1 ? 0.0499F : static_cast<float>(random() % 98) / 1000 - 0.049F;
      };
      origin += point3d(offset(), offset(), offset());
      OcTreeKey found;
      if (!keys.coordToKeyChecked(origin, found)) continue;
      if (RayCast ray; startCast(keys, origin, found, unitVector(direction), ray)) check(ray, random);
      if (testing::Test::HasFatalFailure()) return;
    }
}

/// A ray step by step.
struct Reference {
  explicit Reference(const RayCast& start) {
    for (unsigned i = 0; i < 3; ++i) {
      ray.t_max[i] = start.t_max[i];
      ray.t_delta[i] = start.t_delta[i];
      ray.step[i] = (start.mirror & cell_word::kAxis[i]) != 0 ? -1 : 1;
    }
    ray.key = cell_word::toKey(start.cell());
  }

  Ray ray;
  double entry = 0;
  bool in_space = true;

  void step() {
    const int axis = ray.nextAxis();
    const OcTreeKey before = ray.key;
    entry = ray.exitDistance();
    ray.advance(axis);
    const auto i = static_cast<unsigned>(axis);
    in_space = std::abs(int{ray.key[i]} - int{before[i]}) == 1;
    if (!in_space) ray.key = before;
  }
};

template <class LANE>
void expectTheStepsOfARay() {
  std::size_t rays = 0;
  forEachRay([&](const RayCast& start, std::mt19937&) {
    Reference expected(start);
    RayCast ray = start;
    if (ray.stepsToBorder() == 0) return;
    ++rays;
    RaySteps<LANE> now(ray);
    for (int i = 0; i < std::min(ray.stepsToBorder(), 60); ++i) {
      ASSERT_EQ(now.exitDistance(), expected.ray.exitDistance());
      now.take();
      expected.step();
      ASSERT_TRUE(expected.in_space);
      ASSERT_EQ(now.cell(), cell_word::fromKey(expected.ray.key));
    }
    now.store(ray);
    ASSERT_EQ(ray.cell(), cell_word::fromKey(expected.ray.key));
    ASSERT_GE(ray.entry, expected.entry);
    for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_EQ(ray.t_max[axis], expected.ray.t_max[axis]);
  });
  EXPECT_GT(rays, 1000U);
}

TEST(RaySteps, AreThoseOfARay) { expectTheStepsOfARay<Lane>(); }
TEST(RaySteps, AreThoseOfARayWithoutVectors) { expectTheStepsOfARay<PlainLane>(); }

class RayCastOn : public test::OnTarget {};

TEST_P(RayCastOn, LeavesCubesWhereARayDoes) {
  std::size_t left = 0, stopped = 0, at_border = 0;
  forEachRay([&](const RayCast& start, std::mt19937& random) {
    Reference expected(start);
    RayCast ray = start;
    for (int round = 0; round < 8; ++round) {
      const int bits = 3 + static_cast<int>(random() % 14);
      const double limit = random() % 2 == 0 ? kNoLimit : expected.entry + 0.1 * static_cast<double>(random() % 100);
      const OcTreeKey first = expected.ray.key;
      const auto inside = [&](const OcTreeKey& key) {
        return key[0] >> bits == first[0] >> bits && key[1] >> bits == first[1] >> bits &&
               key[2] >> bits == first[2] >> bits;
      };
      do {
        expected.step();
      } while (expected.in_space && inside(expected.ray.key) && expected.entry <= limit);
      leaveCube(ray, bits, limit);
      ASSERT_EQ(ray.in_space, expected.in_space);
      ASSERT_EQ(ray.cell(), cell_word::fromKey(expected.ray.key)) << "2^" << bits << " cells, up to " << limit;
      ++(!ray.in_space ? at_border : inside(expected.ray.key) ? stopped : left);
      if (!ray.in_space) return;
      ASSERT_EQ(ray.entry, expected.entry);
      for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_EQ(ray.t_max[axis], expected.ray.t_max[axis]);
    }
  });
  EXPECT_GT(left, 1000U);
  EXPECT_GT(stopped, 1000U);
  EXPECT_GT(at_border, 1000U);
}

TEST(RayCast, StepsToTheBorderAndNoFurther) {
  forEachRay([](const RayCast& start, std::mt19937&) {
    Reference expected(start);
    RayCast ray = start;
    for (int i = 0; i < 20; ++i) {
      expected.step();
      step(ray);
      ASSERT_EQ(ray.in_space, expected.in_space);
      ASSERT_EQ(ray.cell(), cell_word::fromKey(expected.ray.key));
      if (!ray.in_space) return;
      ASSERT_EQ(ray.entry, expected.entry);
    }
  });
}

/// Around one place: free leaves of all sizes between unknown space, and occupied cells.
template <class Map>
void fill(Map& map, const OcTreeKey& around, std::mt19937& random) {
  const auto fillCube = [&](unsigned bits, float value) {
    OcTreeKey corner;
    for (unsigned axis = 0; axis < 3; ++axis)
      corner[axis] = static_cast<key_type>((around[axis] + random() % 64 - 32) >> bits << bits);
    for (unsigned cell = 0; cell < 1U << 3 * bits; ++cell) {
      const auto along = [&](unsigned axis) { return cell >> axis * bits & ((1U << bits) - 1); };
      map.setNodeValue(
          OcTreeKey(static_cast<key_type>(corner[0] + along(0)), static_cast<key_type>(corner[1] + along(1)),
                    static_cast<key_type>(corner[2] + along(2))),
          value, true);
    }
  };
  for (unsigned i = 0; i < 60; ++i) fillCube(i % 6, -1);
  for (unsigned i = 0; i < 3000; ++i) fillCube(0, 1);
  map.updateInnerOccupancy();
  map.prune();
}

TEST_P(RayCastOn, EndsWhereOctomapsDoes) {
  const double resolution = 0.1;
  std::size_t hits = 0, casts = 0;
  for (const OcTreeKey& around :
       {OcTreeKey(32768, 32768, 32768), OcTreeKey(65500, 40, 33000), OcTreeKey(300, 65535, 0)}) {
    OcTree ours(resolution);
    test::OctomapOracle theirs(resolution);
    std::mt19937 random(23), same(23);
    fill(ours, around, random);
    fill(theirs, around, same);
    ASSERT_EQ(ours.size(), theirs.size());
    for (const point3d& direction : directions(random)) {
      OcTreeKey key;
      for (unsigned axis = 0; axis < 3; ++axis) key[axis] = static_cast<key_type>(around[axis] + random() % 40 - 20);
      const point3d origin = ours.keyToCoord(key) + point3d(0.01F, -0.02F, 0.03F);
      // Some ranges that a cell's centre meets, or nearly.
      for (const double range :
           {-1.0, 0.01, 0.1, 0.15, 0.2, 1.0, 3.0, 3.03, 0.1 * static_cast<double>(random() % 60), kNoLimit})
        for (const bool ignore : {false, true}) {
          point3d end(9, 9, 9), octomaps_end(9, 9, 9);
          const bool hit = ours.castRay(origin, direction, end, ignore, range);
          ASSERT_EQ(hit, theirs.castRay(origin, direction, octomaps_end, ignore, range))
              << origin << " along " << direction << ", " << range << " m";
          ASSERT_EQ(end, octomaps_end) << origin << " along " << direction << ", " << range << " m";
          hits += hit;
          ++casts;
        }
    }
  }
  EXPECT_GT(hits, casts / 20);
  EXPECT_LT(hits, casts / 2);
}

INSTANTIATE_TEST_SUITE_P(Targets, RayCastOn, testing::ValuesIn(test::targetsHere()), test::targetName);

}  // namespace
}  // namespace rhmap
