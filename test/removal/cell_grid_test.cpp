// SPDX-License-Identifier: BSD-3-Clause
#include "cell_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <vector>

namespace rhmap {
namespace {

constexpr int kX = -4, kY = 7, kZ = 100, kSide = 16;

CellGrid randomGrid(unsigned seed, unsigned percent) {
  std::mt19937 random(seed);
  CellGrid grid(kX, kY, kZ, kSide);
  for (int x = kX; x < kX + kSide; ++x)
    for (int y = kY; y < kY + kSide; ++y)
      for (int z = kZ; z < kZ + 64; ++z)
        if (random() % 100 < percent) grid.set(x, y, z);
  return grid;
}

template <class F>
void forEachCellOfTheWindow(F&& visit) {
  for (int x = kX; x < kX + kSide; ++x)
    for (int y = kY; y < kY + kSide; ++y)
      for (int z = kZ; z < kZ + 64; ++z) visit(x, y, z);
}

bool isAtRim(int x, int y) { return x == kX || y == kY || x == kX + kSide - 1 || y == kY + kSide - 1; }

TEST(CellGrid, ErodesToCellsWithAll26Neighbours) {
  const CellGrid grid = randomGrid(10, 97), eroded = grid.eroded({});
  int left = 0;
  forEachCellOfTheWindow([&](int x, int y, int z) {
    bool all = true;
    for (int d = 0; d < 27; ++d) all = all && grid.at(x + d % 3 - 1, y + d / 3 % 3 - 1, z + d / 9 - 1);
    ASSERT_EQ(eroded.at(x, y, z), all) << x << ' ' << y << ' ' << z;  // outside of the window all is clear
    left += all;
  });
  EXPECT_GT(left, 100);
}

TEST(CellGrid, ErodesToCellsWithAllNeighboursButForOneSide) {
  const CellGrid grid = randomGrid(12, 90), eroded = grid.erodedToOneSide({});
  int left = 0;
  forEachCellOfTheWindow([&](int x, int y, int z) {
    std::array<bool, 4> all{true, true, true, true};  // but for those at smaller x, larger x, smaller y, larger y
    for (int d = 0; d < 27; ++d) {
      const int dx = d % 3 - 1, dy = d / 3 % 3 - 1, dz = d / 9 - 1;
      if (grid.at(x + dx, y + dy, z + dz)) continue;
      if (dx >= 0) all[0] = false;
      if (dx <= 0) all[1] = false;
      if (dy >= 0) all[2] = false;
      if (dy <= 0) all[3] = false;
    }
    const bool expected = !isAtRim(x, y) && (all[0] || all[1] || all[2] || all[3]);
    ASSERT_EQ(eroded.at(x, y, z), expected) << x << ' ' << y << ' ' << z;
    left += expected;
  });
  EXPECT_GT(left, 100);
}

TEST(CellGrid, DilatesToCellsWithOneOf26NeighboursExceptFromTheRim) {
  const CellGrid grid = randomGrid(11, 2), dilated = grid.dilated({});
  int found = 0;
  forEachCellOfTheWindow([&](int x, int y, int z) {
    bool any = false;
    for (int d = 0; d < 27; ++d) {
      const int nx = x + d % 3 - 1, ny = y + d / 3 % 3 - 1, nz = z + d / 9 - 1;
      any = any || (grid.at(nx, ny, nz) && !isAtRim(nx, ny));
    }
    ASSERT_EQ(dilated.at(x, y, z), any) << x << ' ' << y << ' ' << z;
    found += any;
  });
  EXPECT_GT(found, 1000);
}

TEST(CellGrid, DoesNotMindWhatWasInTheMemoryItIsGiven) {
  const CellGrid grid = randomGrid(15, 50), other = randomGrid(16, 50);
  const auto expectEqual = [](const CellGrid& a, const CellGrid& b) {
    forEachCellOfTheWindow([&](int x, int y, int z) { ASSERT_EQ(a.at(x, y, z), b.at(x, y, z)); });
  };
  expectEqual(grid.eroded(other), grid.eroded({}));
  expectEqual(grid.erodedToOneSide(other), grid.erodedToOneSide({}));
  expectEqual(grid.dilated(other), grid.dilated({}));
}

TEST(CellGrid, ClosesGapsOfOneCellBetweenUpperAndLower) {
  const CellGrid grid = randomGrid(17, 50), except = randomGrid(18, 50);
  CellGrid closed = grid;
  closed.closeGaps(except);
  int filled = 0;
  forEachCellOfTheWindow([&](int x, int y, int z) {
    const bool is_gap = grid.at(x, y, z - 1) && grid.at(x, y, z + 1) && !except.at(x, y, z);
    ASSERT_EQ(closed.at(x, y, z), grid.at(x, y, z) || is_gap) << x << ' ' << y << ' ' << z;
    filled += is_gap && !grid.at(x, y, z);
  });
  EXPECT_GT(filled, 100);
}

TEST(CellGrid, GrowsIntoWhatIsSetInAnother) {
  const CellGrid other = randomGrid(20, 50);
  CellGrid grid = randomGrid(21, 20);
  for (const Cell from : {Cell{kX + 5, kY + 5, kZ + 30}, Cell{kX, kY + kSide - 1, kZ}, Cell{kX + 3, kY + 3, kZ + 63},
                          Cell{kX + 5, kY + 5, kZ + 64}}) {
    const CellGrid before = grid;
    std::vector<Cell> grown;
    grid.growInto(other, from, grown);
    std::size_t fresh = 0;
    forEachCellOfTheWindow([&](int x, int y, int z) {
      const bool is_near = std::abs(x - from.x) <= 1 && std::abs(y - from.y) <= 1 && std::abs(z - from.z) <= 1;
      const bool is_new = is_near && from.z < kZ + 64 && other.at(x, y, z) && !before.at(x, y, z);
      ASSERT_EQ(grid.at(x, y, z), before.at(x, y, z) || is_new);
      const auto is_this = [&](const Cell& cell) { return cell.x == x && cell.y == y && cell.z == z; };
      ASSERT_EQ(std::count_if(grown.begin(), grown.end(), is_this), is_new);
      fresh += is_new;
    });
    EXPECT_EQ(grown.size(), fresh);
    EXPECT_EQ(fresh > 0, from.z < kZ + 64);
  }
}

TEST(CellGrid, IsClearAfterReset) {
  const CellGrid clear(0, 0, 0, 24), other = randomGrid(19, 50);
  const auto expectClear = [&](CellGrid& grid) {
    for (const int side : {24, 16, 24}) {
      grid.reset(5, 6, 7, side);
      EXPECT_TRUE(grid.empty());
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) ASSERT_EQ(grid.word(x, y), 0) << x << ' ' << y;
      for (int y = 0; y < side; y += 8)
        for (int x = 0; x < side; x += 8) EXPECT_FALSE(grid.mayHold(x, y));
      for (int i = 0; i < side; i += 3) grid.set(5 + i, 6 + i * i % side, 7 + i);
      EXPECT_FALSE(grid.empty());
      for (int i = 0; i < side; i += 3) EXPECT_TRUE(grid.mayHold(i & ~7, i * i % side & ~7));
    }
    grid.reset(0, 0, 0, 24);
  };
  CellGrid grid = clear;
  expectClear(grid);
  grid.data()[77] = 1;
  EXPECT_TRUE(grid.mayHold(0, 0));
  expectClear(grid);
  for (CellGrid filled : {other, other.eroded({}), other.erodedToOneSide({}), other.dilated({})}) expectClear(filled);
  CellGrid closed = other;
  closed.closeGaps(clear);
  expectClear(closed);
}

TEST(CellGrid, KnowsNothingOutsideOfItsWindow) {
  CellGrid grid = randomGrid(14, 100);
  for (const auto& [x, y, z] : {std::array{kX - 1, kY, kZ}, std::array{kX, kY + kSide, kZ}, std::array{kX, kY, kZ + 64},
                                std::array{kX, kY, kZ - 1}}) {
    EXPECT_FALSE(grid.at(x, y, z));
    grid.set(x, y, z);
    EXPECT_FALSE(grid.at(x, y, z));
  }
  grid.reset(kX + 1, kY, kZ, 4);
  EXPECT_FALSE(grid.at(kX + 1, kY, kZ));
}

}  // namespace
}  // namespace rhmap
