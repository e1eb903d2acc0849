// SPDX-License-Identifier: BSD-3-Clause
// What is computed in vectors is what the same arithmetic gives one by one, on every instruction set that there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "cell_counters.hpp"
#include "near_ground.hpp"
#include "pixels.hpp"
#include "range_image.hpp"
#include "scan_points.hpp"
#include "tally.hpp"
#include "targets.hpp"
#include "void_rays.hpp"

namespace rhmap {
namespace {

using VectorCode = test::OnTarget;
INSTANTIATE_TEST_SUITE_P(Targets, VectorCode, testing::ValuesIn(test::targetsHere()), test::targetName);

TEST_P(VectorCode, PixelsAreThoseOfTheProjection) {
  Projection projection = evenProjection(64, 1800, 0.05F, -0.43F);
  for (std::int32_t& row : projection.row) row = row < 30 ? row : 30 + (row - 30) / 2;  // beams that are uneven
  projection.rows = 47;
  std::mt19937 random(3);
  std::normal_distribution<float> normal(0, 10);
  for (const std::size_t n : {0, 1, 7, 16, 1003}) {
    std::vector<float> x(n), y(n), z(n), ranges(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = normal(random), y[i] = normal(random), z[i] = 0.2F * normal(random);
    if (n > 2) y[1] = 0, x[1] = -5;  // where the image begins and ends
    std::vector<std::int32_t> pixels(n, 77);
    pixelsOf(projection, x.data(), y.data(), z.data(), n, pixels.data(), ranges.data());
    int outside = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const float step = projection.stepOf(x[i], y[i], z[i]);
      const bool inside = step >= 0 && step < 64;
      outside += !inside;
      const int row = inside ? projection.row[static_cast<std::size_t>(step)] : 0;
      ASSERT_EQ(pixels[i], inside ? row * 1800 + projection.columnOf(x[i], y[i]) : -1) << i;
      ASSERT_EQ(ranges[i], std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i])) << i;
    }
    if (n > 1000) {
      EXPECT_GT(outside, 100);
      EXPECT_LT(outside, 900);
    }
  }
}

TEST_P(VectorCode, PointsFallIntoOctomapsCubes) {
  std::mt19937 random(6);
  std::normal_distribution<float> normal(0, 20);
  const octomap::pose6d pose(3270, -12.3F, 4.5F, 0.1, -0.2, 2.5);  // points beside the end of the world
  const KeySpace keys(0.1);
  for (const std::size_t n : {1, 63, 64, 1000}) {
    octomap::Pointcloud cloud;
    for (std::size_t i = 0; i < n; ++i)
      cloud.push_back(i % 97 == 5 ? std::nanf("") : normal(random), normal(random), normal(random));
    ScanPoints scan;
    locatePoints(keys, cloud, pose, 5, 60, scan);
    std::size_t k = 0;
    for (const octomap::point3d& p : cloud) {
      const float range = std::sqrt(p.x() * p.x() + p.y() * p.y() + p.z() * p.z());
      OcTreeKey cube;
      if (!(range >= 5 && range <= 60) || !keys.coordToKeyChecked(pose.transform(p), cube)) continue;
      ASSERT_LT(k, scan.size());
      ASSERT_EQ(scan.cubeAt(k), cube);
      ASSERT_EQ(scan.range[k], range);
      ASSERT_EQ(octomap::point3d(scan.x[k], scan.y[k], scan.z[k]), p);
      ++k;
    }
    ASSERT_EQ(scan.size(), k);
    EXPECT_EQ(scan.dropped, n - k);
  }
}

/// Amanatides and Woo, as in a book.
void followOne(const std::array<float, 3>& from, const std::array<float, 3>& to, float share, const CellGrid& hit,
               CellGrid& crossed) {
  std::array<int, 3> cell, step;
  std::array<float, 3> next, delta;
  for (std::size_t i = 0; i < 3; ++i) {
    const float d = to[i] - from[i];
    cell[i] = static_cast<int>(from[i]);
    step[i] = d < 0 ? -1 : 1;
    delta[i] = d == 0 ? 1e30F : std::fabs(1 / d);
    next[i] = d == 0 ? 1e30F : (static_cast<float>(cell[i] + (d < 0 ? 0 : 1)) - from[i]) / d;
  }
  const auto inWindow = [&] {
    const int x = cell[0] - hit.x0(), y = cell[1] - hit.y0(), z = cell[2] - hit.z0();
    return x >= 0 && y >= 0 && z >= 0 && x < hit.side() && y < hit.side() && z < 64;
  };
  while (inWindow() && !hit.at(cell[0], cell[1], cell[2])) {
    crossed.set(cell[0], cell[1], cell[2]);
    const std::size_t i = next[0] <= next[1] && next[0] <= next[2] ? 0 : next[1] <= next[2] ? 1 : 2;
    if (next[i] > share) return;
    next[i] += delta[i], cell[i] += step[i];
  }
}

TEST_P(VectorCode, RaysCrossTheCellsOfAmanatidesAndWoo) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> along(-45, 45), unit(0, 1);
  CellGrid hit(8000, 8000, 8000, 80), expected = hit, crossed = hit;
  const std::array<float, 3> from{8040.3F, 8039.8F, 8028.5F};
  for (int i = 0; i < 3000; ++i)
    hit.set(8000 + static_cast<int>(80 * unit(random)), 8000 + static_cast<int>(80 * unit(random)),
            8000 + static_cast<int>(64 * unit(random)));
  VoidRays rays;
  for (int i = 0; i < 501; ++i) {
    std::array<float, 3> to{from[0] + along(random), from[1] + along(random), from[2] + 0.7F * along(random)};
    if (i % 50 == 0) to[1] = from[1];  // along the axes
    if (i % 100 == 0) to[2] = from[2];
    const float share = unit(random) < 0.3F ? unit(random) : 1;
    rays.push(to, share);
    followOne(from, to, share, hit, expected);
  }
  followRays(from, rays, hit, crossed);
  EXPECT_FALSE(crossed.empty());
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x) ASSERT_EQ(crossed.word(x, y), expected.word(x, y)) << x << ' ' << y;
}

TEST_P(VectorCode, ATallyCountsEachOfItsCubes) {
  std::mt19937_64 random(8);
  Tally tally{}, expected{};
  for (int i = 0; i < 1500; ++i) {
    const std::uint64_t cubes = i % 7 == 0 ? ~std::uint64_t{0} : random() & random();
    const int enough = i % 11 == 0 ? 255 : i % 13 == 0 ? 1 : 3 + i / 4;
    std::uint64_t reached = 0;
    for (std::size_t bit = 0; bit < 64; ++bit) {
      if ((cubes >> bit & 1) == 0) continue;
      countUp(expected[bit]);
      reached |= std::uint64_t{expected[bit] >= enough} << bit;
    }
    if (enough > 255) continue;
    ASSERT_EQ(countUp(tally, cubes, enough), reached) << i;
    ASSERT_EQ(tally, expected) << i;
  }
  EXPECT_EQ(*std::max_element(tally.begin(), tally.end()), 255);
}

TEST_P(VectorCode, CubesOfTheGroundAreNearOneOfItsPlanes) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> slant(-0.4F, 0.4F), height(-3, 12);
  const GroundBand band{.r_gro = 2.5F, .depth = 4, .thin = 0.7F};
  int ground = 0, safe = 0;
  for (int round = 0; round < 200; ++round) {
    std::array<Plane, 5> planes;
    std::array<NearPlane, 5> near;
    const auto n = static_cast<std::size_t>(round % 6);  // none, too
    for (std::size_t i = 0; i < n; ++i) {
      planes[i] = {.n = {slant(random), slant(random), 0.9F}, .d = height(random)};
      near[i] = {&planes[i], i == 1 ? 8.0F : 0.0F, i == 2 ? -8.0F : 0.0F, i == 3 ? 8.0F : 0.0F};
    }
    const std::array<int, 3> corner{4 * (round % 2), 4 * (round / 2 % 2), 4 * (round / 4 % 2)};
    const GroundCubes cubes = nearGround({near.data(), n}, corner, band);
    for (int bit = 0; bit < 64; ++bit) {
      const auto& place = kPlaceInOctant[static_cast<std::size_t>(bit)];
      float lowest = band.r_gro;
      for (std::size_t i = 0; i < n; ++i) {
        const float above = planes[i].above(static_cast<float>(corner[0] + place[0]) + near[i].dx,
                                            static_cast<float>(corner[1] + place[1]) + near[i].dy,
                                            static_cast<float>(corner[2] + place[2]) + near[i].dz);
        if (above >= -band.depth) lowest = std::min(lowest, above);
      }
      ASSERT_EQ(cubes.ground >> bit & 1, lowest < band.r_gro) << round << ' ' << bit;
      ASSERT_EQ(cubes.safe >> bit & 1, lowest <= band.thin) << round << ' ' << bit;
      ground += lowest < band.r_gro, safe += lowest <= band.thin;
    }
  }
  EXPECT_GT(safe, 1000);
  EXPECT_GT(ground, safe + 1000);
  EXPECT_LT(ground, 200 * 64 - 1000);
}

TEST(Counters, CountAsSixtyFourCounters) {
  std::mt19937_64 random(5);
  Counters<3> counters, before;
  std::array<unsigned, 64> expected{}, expected_before{};
  for (int i = 0; i < 300; ++i) {
    const std::uint64_t up = random() & random(), reset = random() & random() & random() & random();
    counters.reset(reset);
    counters.countUp(up);
    for (std::size_t c = 0; c < 64; ++c) {
      if (reset >> c & 1) expected[c] = 0;
      if (up >> c & 1) expected[c] = std::min(expected[c] + 1, 7U);
    }
    if (i == 150) {  // all cells move down by three
      counters.shift(3);
      std::shift_left(expected.begin(), expected.end(), 3);
      std::fill(expected.end() - 3, expected.end(), 0U);
    }
    for (unsigned n = 0; n <= 9; ++n)
      for (std::size_t c = 0; c < 64; ++c) ASSERT_EQ(counters.atLeast(n) >> c & 1, expected[c] >= n) << n << ' ' << c;
    for (std::size_t c = 0; c < 64; ++c)
      ASSERT_EQ(counters.moreThan(before) >> c & 1, expected[c] > expected_before[c]) << c;
    before = counters, expected_before = expected;
  }
}

}  // namespace
}  // namespace rhmap
