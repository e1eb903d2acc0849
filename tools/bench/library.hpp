// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/Pointcloud.h>

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rhmap/core/key.hpp"
#include "workload.hpp"

namespace rhmap::bench {

/// One measurement.
struct Sample {
  double seconds = 0;          ///< processor time of the thread: what other programs take is not in it
  std::size_t operations = 1;  ///< calls, cells, nodes ... that the time is shared out to
  std::uint64_t answer = 0;    ///< the same for both libraries, or one of them is wrong
};

/// A benchmark's name and what its time is given for ("scan", "call", "leaf", ...).
struct Title {
  std::string_view name;
  std::string_view per;
};

/// The benchmarks, in the order of their numbers: one scan after the other into a map, and everything else on the map
/// that scan benchmark 0 has built.
std::span<const Title> scanTitles();
std::span<const Title> mapTitles();

/// A library under test with one map of one resolution. The two are the same text (TreeLibrary) over different trees.
class Library {
 public:
  virtual ~Library() = default;

  /// Inserts a scan into the map of that scan benchmark.
  virtual Sample insert(std::size_t benchmark, const WorldScan& scan, double max_range) = 0;

  /// A hash over all nodes (place, depth and value) of that scan benchmark's map. Frees the map, unless it is number 0.
  virtual std::uint64_t finish(std::size_t benchmark) = 0;

  /// Replaces the map by the one in a .bt stream; false if it cannot be read.
  virtual bool readBinary(std::istream& stream) = 0;

  virtual std::size_t nodeCount() const = 0;

  /// The keys of all leaves, in the order of the iterator.
  virtual std::vector<octomap::OcTreeKey> leafKeys() const = 0;

  /// Whether there is a node around each of these keys.
  virtual std::vector<bool> known(std::span<const octomap::OcTreeKey> keys) const = 0;

  /// Runs a map benchmark; the map may change, by the same steps in both libraries.
  virtual Sample run(std::size_t benchmark, const MapWorkload& work, std::size_t round) = 0;

  /// Physical memory [bytes] of the map, by destroying it: call it in a forked process.
  virtual std::optional<std::size_t> destroyForMemory() = 0;
};

/// Each in a source file of its own; OctoMap's templates are compiled in none but its own.
std::unique_ptr<Library> makeOctomap(double resolution);
std::unique_ptr<Library> makeRhmap(double resolution);

}  // namespace rhmap::bench
