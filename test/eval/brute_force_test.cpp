// SPDX-License-Identifier: BSD-3-Clause
// The protocols once more, as their definitions read: every point against every point, no grids and no passes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "memory_scans.hpp"

namespace rhmap::eval::test {
namespace {

using Scans = std::vector<std::vector<Labelled>>;
using CellKey = std::array<int, 3>;

CellKey cellOf(const octomap::point3d& point, double edge) {
  const auto along = [edge](float value) { return static_cast<int>(std::floor(value / edge)); };
  return {along(point.x()), along(point.y()), along(point.z())};
}

double distance(const octomap::point3d& a, const octomap::point3d& b) {
  return std::hypot(static_cast<double>(a.x()) - b.x(), static_cast<double>(a.y()) - b.y(),
                    static_cast<double>(a.z()) - b.z());
}

bool moves(std::uint32_t label) { return (label & 0xffff) >= 251 && (label & 0xffff) <= 259; }
bool ignored(std::uint32_t label) { return (label & 0xffff) == 0; }

std::vector<Labelled> joined(const Scans& scans) {
  std::vector<Labelled> all;
  for (const auto& scan : scans) all.insert(all.end(), scan.begin(), scan.end());
  return all;
}

std::vector<Labelled> keptOf(const std::vector<Labelled>& points, const Estimate& row) {
  if (!row.keep) return {};
  const KeptMask mask = row.keep(labelledScan(points));
  std::vector<Labelled> kept;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (mask[k]) kept.push_back(points[k]);
  }
  return kept;
}

std::vector<Labelled> asLabelled(const std::vector<octomap::point3d>& cloud) {
  std::vector<Labelled> points;
  for (const auto& point : cloud) points.push_back({point, 0});
  return points;
}

Counts kth(const Scans& scans, const Estimate& row) {
  const auto all = joined(scans);
  const auto map = row.keep ? keptOf(all, row) : asLabelled(row.cloud);
  Counts counts;
  for (const Labelled& each : all) {
    const bool kept = std::any_of(map.begin(), map.end(),
                                  [&](const Labelled& other) { return distance(other.point, each.point) <= 0.05; });
    counts.add(Labels(), each.label, kept);
  }
  return counts;
}

/// Nearest in order of distance, then of place; nullptr if there is none.
const Labelled* nearest(const std::vector<Labelled>& points, const octomap::point3d& query) {
  const Labelled* best = nullptr;
  for (const Labelled& each : points) {
    if (!best || distance(each.point, query) < distance(best->point, query)) best = &each;
  }
  return best;
}

std::vector<octomap::point3d> centroids(const std::vector<Labelled>& points) {
  std::map<CellKey, std::array<double, 4>> sums;
  std::vector<CellKey> order;
  for (const Labelled& each : points) {
    const CellKey key = cellOf(each.point, 0.2);
    if (!sums.contains(key)) order.push_back(key);
    auto& sum = sums[key];
    sum[0] += each.point.x(), sum[1] += each.point.y(), sum[2] += each.point.z(), ++sum[3];
  }
  std::vector<octomap::point3d> result;
  for (const CellKey& key : order) {
    const auto& [x, y, z, n] = sums[key];
    result.emplace_back(static_cast<float>(x / n), static_cast<float>(y / n), static_cast<float>(z / n));
  }
  return result;
}

std::vector<Labelled> labelledFrom(const std::vector<octomap::point3d>& points, const std::vector<Labelled>& cloud) {
  std::vector<Labelled> result;
  for (const auto& point : points) result.push_back({point, nearest(cloud, point)->label});
  return result;
}

std::vector<Labelled> voxelised(const std::vector<Labelled>& points) { return labelledFrom(centroids(points), points); }

Counts erasor(const Scans& scans, const Estimate& row) {
  std::vector<Labelled> dense, kept, carried;
  for (const auto& scan : scans) {
    const auto part = voxelised(scan);
    dense.insert(dense.end(), part.begin(), part.end());
    const auto kept_part = keptOf(scan, row);
    kept.insert(kept.end(), kept_part.begin(), kept_part.end());
    const auto carried_part = voxelised(kept_part);
    carried.insert(carried.end(), carried_part.begin(), carried_part.end());
  }
  const auto estimate =
      row.keep ? labelledFrom(centroids(kept), carried) : labelledFrom(centroids(asLabelled(row.cloud)), dense);
  Counts counts;
  for (const Labelled& truth : voxelised(dense)) {
    const Labelled* near = nearest(estimate, truth.point);
    counts.add(Labels(), truth.label,
               near && distance(near->point, truth.point) < 0.2 * std::sqrt(3) / 2 &&
                   moves(near->label) == moves(truth.label));
  }
  return counts;
}

Counts rhmapCubes(const Scans& scans, const Estimate& row) {
  const auto all = joined(scans);
  auto kept = keptOf(all, row);
  std::map<CellKey, bool> hit;
  for (const auto& point : row.cloud) hit[cellOf(point, 0.1)] = true;
  for (const Labelled& each : all) {
    if (hit.contains(cellOf(each.point, 0.1))) kept.push_back(each);
  }
  // By cube: how many of each label.
  std::map<CellKey, std::map<std::uint32_t, int>> truth, left;
  for (const Labelled& each : all) ++truth[cellOf(each.point, 0.1)][each.label & 0xffff];
  for (const Labelled& each : kept) ++left[cellOf(each.point, 0.1)][each.label & 0xffff];
  const auto majorityMoves = [](const std::map<std::uint32_t, int>& labels) {
    int balance = 0;
    for (const auto& [label, count] : labels) balance += moves(label) ? count : ignored(label) ? 0 : -count;
    return balance > 0;
  };
  Counts counts;
  for (const auto& [cell, labels] : truth) {
    if (labels.size() == 1 && labels.contains(0)) continue;
    std::uint32_t of = 9;
    if (majorityMoves(labels)) {
      int most = 0;
      for (const auto& [label, count] : labels) {
        if (moves(label) && count > most) of = label, most = count;
      }
    }
    counts.add(Labels(), of, left.contains(cell) && majorityMoves(left[cell]) == majorityMoves(labels));
  }
  return counts;
}

/// Rows that keep half of the box, every other decimetre, all, nothing, and clouds of every kind.
std::vector<Estimate> someRows(unsigned seed) {
  std::vector<Estimate> rows{keptBelow(0), keptBy("decimetres", [](const octomap::point3d& point) {
                               return (cellOf(point, 0.1)[0] + cellOf(point, 0.1)[1]) % 2 == 0;
                             })};
  rows.push_back(keptBy("fine", [](const octomap::point3d& point) { return cellOf(point, 0.03)[0] % 2 == 0; }));
  rows.push_back(keptBelow(9));
  rows.push_back(keptBelow(-9));
  std::vector<octomap::point3d> cloud;
  for (const Labelled& each : joined(randomScans(seed + 100, 1, 200))) cloud.push_back(each.point * 0.9F);
  rows.push_back(keptInCloud("cloud", cloud));
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].name = std::to_string(k);
  return rows;
}

using Reference = Counts (*)(const Scans&, const Estimate&);

void expectSame(const std::string& protocol, std::optional<Counts> Score::*part, Reference reference) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Scans scans = randomScans(seed, 3, 400);
    const auto rows = someRows(seed);
    const auto scores = evaluate(MemoryScans(scans), only(protocol), rows);
    for (const Estimate& row : rows)
      EXPECT_EQ(*(scoreOf(scores, row.name).*part), reference(scans, row)) << "seed " << seed << ", row " << row.name;
    EXPECT_EQ(*(scoreOf(scores, "oracle").*part), reference(scans, oracle(Labels()))) << "seed " << seed;
  }
}

TEST(BruteForce, FindsTheCountsOfProtocolRhmap) { expectSame("rhmap", &Score::cells, rhmapCubes); }
TEST(BruteForce, FindsTheCountsOfProtocolErasor) { expectSame("erasor", &Score::cells, erasor); }
TEST(BruteForce, FindsTheCountsOfProtocolKth) { expectSame("kth", &Score::points, kth); }

}  // namespace
}  // namespace rhmap::eval::test
