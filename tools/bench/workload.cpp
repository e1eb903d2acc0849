// SPDX-License-Identifier: BSD-3-Clause
#include "workload.hpp"

#include <algorithm>
#include <array>
#include <random>
#include <stdexcept>

#include "library.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "rhmap/octree/ray.hpp"

namespace rhmap::bench {
namespace {

constexpr std::size_t kQueries = 2'000'000;
constexpr std::size_t kCasts = 100'000;
constexpr std::size_t kUpdates = 100'000;

using Random = std::mt19937_64;

std::size_t below(std::size_t n, Random& random) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

/// Smallest and largest key of the leaves.
struct Bounds {
  OcTreeKey min, max;
};

Bounds boundsOf(std::span<const OcTreeKey> leaves) {
  Bounds bounds{leaves.front(), leaves.front()};
  for (const OcTreeKey& leaf : leaves) {
    for (unsigned i = 0; i < 3; ++i) {
      bounds.min[i] = std::min(bounds.min[i], leaf[i]);
      bounds.max[i] = std::max(bounds.max[i], leaf[i]);
    }
  }
  return bounds;
}

OcTreeKey uniformKey(const Bounds& bounds, Random& random) {
  OcTreeKey key;
  for (unsigned i = 0; i < 3; ++i)
    key[i] = static_cast<key_type>(bounds.min[i] + below(std::size_t{1} + bounds.max[i] - bounds.min[i], random));
  return key;
}

std::vector<OcTreeKey> cellsOfRays(const KeySpace& keys, std::span<const WorldScan> scans, Random& random) {
  std::vector<OcTreeKey> cells;
  while (cells.size() < kQueries) {
    const WorldScan& scan = scans[below(scans.size(), random)];
    const point3d& end = scan.points[static_cast<unsigned>(below(scan.points.size(), random))];
    forEachRayKey(keys, scan.origin, end, [&](const OcTreeKey& key) { cells.push_back(key); });
  }
  return cells;
}

std::vector<Cast> randomCasts(std::span<const WorldScan> scans, Random& random) {
  std::normal_distribution<float> normal;
  std::vector<Cast> casts;
  for (std::size_t i = 0; i < kCasts; ++i)
    casts.push_back({scans[i % scans.size()].origin, {normal(random), normal(random), normal(random)}});
  return casts;
}

std::vector<CellUpdate> randomUpdates(std::span<const OcTreeKey> leaves, Random& random) {
  std::vector<CellUpdate> updates;
  for (std::size_t i = 0; i < kUpdates; ++i)
    updates.push_back({leaves[below(leaves.size(), random)], below(2, random) == 1});
  return updates;
}

std::vector<CellUpdate> unknownCells(const Library& library, const Bounds& bounds, Random& random) {
  std::vector<OcTreeKey> candidates(2 * kUpdates);
  for (OcTreeKey& key : candidates) key = uniformKey(bounds, random);
  const std::vector<bool> known = library.known(candidates);
  std::vector<CellUpdate> cells;
  for (std::size_t i = 0; i < candidates.size() && cells.size() < kUpdates; ++i)
    if (!known[i]) cells.push_back({candidates[i], below(2, random) == 1});
  return cells;
}

/// 47 cells an edge: not a multiple of anything.
std::vector<CellUpdate> boxCells(const OcTreeKey& corner) {
  constexpr unsigned kEdge = 47;
  std::vector<CellUpdate> cells;
  for (unsigned z = 0; z < kEdge; ++z)
    for (unsigned y = 0; y < kEdge; ++y)
      for (unsigned x = 0; x < kEdge; ++x)
        cells.push_back({{static_cast<key_type>(corner[0] + x), static_cast<key_type>(corner[1] + y),
                          static_cast<key_type>(corner[2] + z)},
                         false});
  return cells;
}

}  // namespace

std::vector<WorldScan> loadScans(const std::filesystem::path& sequence, std::size_t count) {
  const auto recording = io::openSequence(sequence);
  if (count > recording->size())
    throw std::runtime_error(sequence.string() + " has " + std::to_string(recording->size()) + " scans, not " +
                             std::to_string(count));
  std::vector<WorldScan> scans;
  for (std::size_t i = 0; i < count; ++i) {
    io::Scan scan = recording->scan(i);
    scan.points.transform(scan.pose);
    scans.push_back({std::move(scan.points), scan.pose.trans()});
  }
  return scans;
}

MapWorkload drawWorkload(const Library& library, double resolution, std::span<const WorldScan> scans,
                         std::size_t rounds) {
  Random random(1);
  const KeySpace keys(resolution);
  const std::vector<OcTreeKey> leaves = library.leafKeys();
  const Bounds bounds = boundsOf(leaves);

  MapWorkload work;
  for (std::size_t i = 0; i < kQueries; ++i) {
    work.leaves.push_back(leaves[below(leaves.size(), random)]);
    work.points.push_back(keys.keyToCoord(uniformKey(bounds, random)));
  }
  work.ray_cells = cellsOfRays(keys, scans, random);
  work.casts = randomCasts(scans, random);
  const point3d& centre = scans.front().origin;
  const point3d half(10, 10, 3);
  keys.coordToKeyChecked(centre - half, work.box_min);
  keys.coordToKeyChecked(centre + half, work.box_max);

  for (std::size_t round = 0; round < rounds; ++round) {
    work.known_cells.push_back(randomUpdates(leaves, random));
    work.scattered_cells.push_back(unknownCells(library, bounds, random));
    work.box_cells.push_back(
        boxCells({bounds.min[0], bounds.min[1], static_cast<key_type>(bounds.max[2] + 64 * (round + 1))}));
  }
  return work;
}

}  // namespace rhmap::bench
