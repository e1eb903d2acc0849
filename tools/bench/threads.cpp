// SPDX-License-Identifier: BSD-3-Clause
#include "threads.hpp"

#include <chrono>
#include <latch>
#include <memory>
#include <thread>

#include "rhmap/octree/octree.hpp"

namespace rhmap::bench {
namespace {

double secondsOf(OcTree& map, const WorldScan& scan, double max_range) {
  const auto start = std::chrono::steady_clock::now();
  map.insertPointCloud(scan.points, scan.origin, max_range);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Maps that get the same scan at the same time, each from a thread of its own.
class MapsApart {
 public:
  MapsApart(double resolution, int threads) {
    for (int i = 0; i < threads; ++i) maps_.push_back(std::make_unique<OcTree>(resolution));
  }

  /// A scan's share of the time, were they to take as many as each can.
  double secondsOf(const WorldScan& scan, double max_range) {
    std::vector<double> seconds(maps_.size());
    std::latch start(static_cast<std::ptrdiff_t>(maps_.size()));
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < maps_.size(); ++i)
      threads.emplace_back([&, i] {
        start.arrive_and_wait();
        seconds[i] = bench::secondsOf(*maps_[i], scan, max_range);
      });
    threads.clear();  // waits for all
    double scans_a_second = 0;
    for (const double s : seconds) scans_a_second += 1 / s;
    return 1 / scans_a_second;
  }

 private:
  std::vector<std::unique_ptr<OcTree>> maps_;
};

}  // namespace

ThreadsRow compareThreads(std::span<const WorldScan> scans, double resolution, int threads, double max_range,
                          std::size_t rounds) {
  ThreadsRow row{.resolution = resolution, .threads = threads, .one = {}, .several = {}, .apart = {}};
  for (std::size_t round = 0; round < rounds; ++round) {
    OcTree by_one(resolution), by_several(resolution);
    by_several.setNumThreads(threads);
    MapsApart apart(resolution, threads);
    for (std::size_t i = 0; i < scans.size(); ++i) {
      for (std::size_t turn = 0; turn < 3; ++turn) {
        const std::size_t which = (round + i + turn) % 3;
        if (which == 0) row.one.push_back(secondsOf(by_one, scans[i], max_range));
        if (which == 1) row.several.push_back(secondsOf(by_several, scans[i], max_range));
        if (which == 2) row.apart.push_back(apart.secondsOf(scans[i], max_range));
      }
    }
    row.same_answers = row.same_answers && by_one == by_several;
  }
  return row;
}

}  // namespace rhmap::bench
