// SPDX-License-Identifier: BSD-3-Clause
#include "scan_octants.hpp"

#include <gtest/gtest.h>

#include <map>

#include "small_world.hpp"

namespace rhmap {
namespace {

TEST(ScanOctants, HoldEachCubeOfAScanOnceInTheOrderOfTheFirstPoints) {
  test::RandomCubes random(21, 30);
  ScanOctants octants;
  for (const std::size_t n : {1, 31, 5000, 0, 300}) {  // one after another in the same memory
    std::vector<OcTreeKey> cubes;
    for (std::size_t i = 0; i < n; ++i) cubes.push_back(i % 3 == 0 || i == 0 ? random() : cubes.back());
    ScanPoints points = test::pointsIn(cubes);
    for (std::size_t i = 0; i < n; ++i) points.range[i] = i % 5 == 0 ? 60.0F : 50.0F;
    octants.gather(points, 50);

    std::vector<HitOctant> expected;
    std::map<std::uint64_t, std::size_t> at;
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint64_t name = cell_word::fromKey(cubes[i]) >> 6;
      const auto [known, is_new] = at.try_emplace(name, expected.size());
      if (is_new) expected.push_back({.name = name});
      HitOctant& octant = expected[known->second];
      octant.cubes |= maskOf(bitOf(cubes[i]));
      if (i % 5 == 0) continue;
      octant.reached |= maskOf(bitOf(cubes[i]));
      ++octant.points;
    }
    ASSERT_EQ(octants.list().size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const HitOctant& octant = octants.list()[i];
      EXPECT_EQ(octant.name, expected[i].name);
      EXPECT_EQ(octant.cubes, expected[i].cubes);
      EXPECT_EQ(octant.reached, expected[i].reached);
      EXPECT_EQ(octant.points, expected[i].points);
      const OcTreeKey corner = octant.corner();
      EXPECT_EQ(cell_word::fromKey(corner), octant.name << 6);
    }
  }
}

}  // namespace
}  // namespace rhmap
