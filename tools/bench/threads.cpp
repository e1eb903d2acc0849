// SPDX-License-Identifier: BSD-3-Clause
#include "threads.hpp"

#include <array>
#include <chrono>

#include "rhmap/octree/octree.hpp"

namespace rhmap::bench {

ThreadsRow compareThreads(std::span<const WorldScan> scans, double resolution, int threads, double max_range,
                          std::size_t rounds) {
  ThreadsRow row{.resolution = resolution, .threads = threads, .one = {}, .several = {}};
  for (std::size_t round = 0; round < rounds; ++round) {
    std::array<OcTree, 2> maps{OcTree(resolution), OcTree(resolution)};
    maps[1].setNumThreads(threads);
    for (std::size_t i = 0; i < scans.size(); ++i) {
      for (const std::size_t which : {(round + i) % 2, 1 - (round + i) % 2}) {
        const auto start = std::chrono::steady_clock::now();
        maps[which].insertPointCloud(scans[i].points, scans[i].origin, max_range);
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        (which == 0 ? row.one : row.several).push_back(time.count());
      }
    }
    row.same_answers = row.same_answers && maps[0] == maps[1];
  }
  return row;
}

}  // namespace rhmap::bench
