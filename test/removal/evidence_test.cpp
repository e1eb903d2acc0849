// SPDX-License-Identifier: BSD-3-Clause
#include "evidence.hpp"

#include <gtest/gtest.h>

#include <random>

#include "small_world.hpp"

namespace rhmap {
namespace {

TEST(Neighbourhood, OfNothingDoesNotMove) { EXPECT_FALSE(Neighbourhood{}.isMoving(0)); }

TEST(Neighbourhood, MovesIfEnoughOfItDoes) {
  EXPECT_TRUE((Neighbourhood{.moving = 4, .firm = 1}.isMoving(0.8)));
  EXPECT_FALSE((Neighbourhood{.moving = 4, .firm = 1}.isMoving(0.81)));
}

TEST(LookAround, CountsTheCubesOfAnOctantAndSoManyAround) {
  for (const int size : {4, 8, 16}) {
    RegionMap map = test::emptyMap(size);
    test::RandomCubes cubes(8, 16);
    std::mt19937 random(9);
    std::vector<OcTreeKey> doubted, firm, others;
    for (int i = 0; i < 4000; ++i) {
      const OcTreeKey cube = cubes();
      if (test::isOccupied(map, cube)) continue;
      Octant& octant = test::occupy(map, cube);
      const std::uint64_t mask = maskOf(bitOf(cube));
      const unsigned kind = random() % 4;
      if (kind == 0) octant.doubted |= mask, doubted.push_back(cube);
      if (kind == 1) octant.firm |= mask, firm.push_back(cube);
      if (kind == 2) octant.firm |= mask, octant.ground |= mask;  // ground speaks for nothing
      if (kind == 3) others.push_back(cube);
    }
    for (int i = 0; i < 60; ++i) {
      const OcTreeKey cube = cubes();
      const int reach = 1 + i % kFarthestAround;
      const OcTreeKey corner = test::cornerOf(cube);
      const auto isNear = [&](const OcTreeKey& other) { return test::isWithin(other, corner, reach); };
      const Neighbourhood around =
          lookAround(map, corner, reach, [](const Region& region, std::size_t o) { return region.octant(o).doubted; });
      EXPECT_EQ(around.moving, std::count_if(doubted.begin(), doubted.end(), isNear));
      EXPECT_EQ(around.firm, std::count_if(firm.begin(), firm.end(), isNear));
      EXPECT_EQ(around.others, std::count_if(others.begin(), others.end(), isNear));
    }
  }
}

TEST(LookAround, EndsAtTheRimOfTheTree) {
  for (const int size : {4, 8, 16}) {
    for (const key_type rim : {key_type{0}, key_type{0xfffc}}) {
      RegionMap map = test::emptyMap(size);
      const OcTreeKey corner(rim, rim, rim), opposite(static_cast<key_type>(0xfffc - rim), rim, rim);
      for (const OcTreeKey& cube : {corner, opposite}) test::occupy(map, cube).firm |= maskOf(bitOf(cube));
      EXPECT_EQ(lookAround(map, corner, 4, [](const Region&, std::size_t) { return std::uint64_t{0}; }).firm, 1);
    }
  }
}

TEST(LookAround, TakesADistanceAs1To4Cubes) {
  EXPECT_EQ(cubesAround(0.2, 0.1), 2);
  EXPECT_EQ(cubesAround(0.2, 0.2), 1);
  EXPECT_EQ(cubesAround(0.2, 0.5), 1);
  EXPECT_EQ(cubesAround(0.2, 0.01), 4);
}

}  // namespace
}  // namespace rhmap
