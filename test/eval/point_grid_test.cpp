// SPDX-License-Identifier: BSD-3-Clause
#include "point_grid.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>

namespace rhmap::eval {
namespace {

TEST(CellMap, NumbersCellsInTheOrderOfTheirFirstVisit) {
  std::mt19937 random(1);
  std::map<std::array<std::int64_t, 3>, std::uint32_t> expected;
  CellMap cells;
  for (int k = 0; k < 20000; ++k) {
    const auto coordinate = [&random] { return static_cast<std::int64_t>(random() % 41) - 20; };
    const Cell cell{coordinate(), coordinate(), coordinate()};
    const auto id =
        expected.try_emplace({cell.x, cell.y, cell.z}, static_cast<std::uint32_t>(expected.size())).first->second;
    ASSERT_EQ(cells.findOrAdd(cell), id);
  }
  EXPECT_EQ(cells.size(), expected.size());
  EXPECT_EQ(cells.find({21, 0, 0}), CellMap::kNone);
}

TEST(CellGrid, RefusesWhatIsTooFarAndEdgesOf0) {
  EXPECT_THROW(CellGrid(0.1).cellOf(octomap::point3d(1e6F, 0, 0)), std::out_of_range);
  EXPECT_THROW(CellGrid(0.1).cellOf(octomap::point3d(std::numeric_limits<float>::quiet_NaN(), 0, 0)),
               std::out_of_range);
  EXPECT_THROW(CellGrid(0), std::invalid_argument);
  EXPECT_EQ(CellGrid(0.1).cellOf({-0.05F, 0, 0.05F}), (Cell{-1, 0, 0}));
}

TEST(PointGrid, FindsWhatBruteForceFinds) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<octomap::point3d> points(500);
  for (auto& point : points) point = {unit(random), unit(random), unit(random)};
  points.push_back(points[7]);  // equally near
  for (const double edge : {0.05, 0.2, 1.0}) {
    const PointGrid grid(points, edge);
    for (int k = 0; k < 300; ++k) {
      const octomap::point3d query =
          k < 10 ? points[static_cast<std::size_t>(k)] : octomap::point3d{unit(random), unit(random), unit(random)};
      std::optional<PointGrid::Neighbour> expected;
      for (std::uint32_t i = 0; i < points.size(); ++i) {
        const double squared = squaredDistance(points[i], query);
        if (squared <= 0.15 * 0.15 && (!expected || squared < expected->squared_distance)) expected = {i, squared};
      }
      const auto found = grid.nearest(query, 0.15);
      ASSERT_EQ(found.has_value(), expected.has_value());
      if (found) {
        EXPECT_EQ(found->index, expected->index);
      }
    }
  }
}

TEST(PointGrid, WithoutPointsHasNoNeighbours) { EXPECT_FALSE(PointGrid({}, 0.1).nearest({0, 0, 0}, 1)); }

}  // namespace
}  // namespace rhmap::eval
