// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

#include "cell_counters.hpp"
#include "cell_grid.hpp"
#include "free_space.hpp"
#include "scan_context.hpp"
#include "scan_to_map.hpp"

namespace rhmap {

/// Finds in a scan what moves before it enters the map: what is hit in the void, what has come to a place that past
/// scans saw through, and what belongs to these.
class MovingHits {
 public:
  /// `cube`: edge of a cube [m].
  MovingHits(const RemovalConfig& config, double cube);

  /// Takes the hits of what moves out of the regions. Cubes that the map had before are appended to `removed`. Returns
  /// the number of cubes taken out.
  std::size_t reject(const RegionMap& map, const ScanTrace& trace, const FreeSpace& free_space,
                     std::vector<RemovedCubesOf>& removed);

  /// The octants (their lowest cubes) that the last call has taken hits out of.
  const std::vector<OcTreeKey>& rejectedFrom() const { return rejected_from_; }

  /// A scan to look back at from now on.
  void remember(std::uint32_t scan, const ScanContext& context);

 private:
  struct Past {
    SensorView view;
    std::shared_ptr<const Visibility> visibility;
  };

  /// A cell from which what moves grows, by so many steps.
  struct Seed {
    Cell cell;
    int steps;
  };

  /// What past scans say of an octant's new cubes: how many have seen through each, or something at its place.
  struct Answers {
    Counters<8> seen, contrary;
  };

  bool isNew(const RegionMap& map, const ScanTrace& trace, const OcTreeKey& corner) const;
  void lookBack(const ScanTrace& trace);
  bool isTooNear(const SensorView& view, const OcTreeKey& corner) const;
  int stepsFrom(const Cell& come, const FreeSpace& free_space) const;
  void growSeeds(const CellGrid& ends);

  RemovalConfig config_;
  // In cubes.
  int reach_;
  double least_new_, least_come_;
  float nearest_;  // an octant's middle must be this far away to be known empty
  std::deque<Past> past_;
  std::vector<OcTreeKey> rejected_from_;

  // For one scan, and kept for their memory.
  std::vector<Seed> seeds_;
  CellGrid moving_;                   // cells of what moves
  std::vector<Cell> rim_, next_rim_;  // of these, the last ones
  std::vector<CubesAt> fresh_;        // what is new to the map, and of each octant
  std::vector<Octant*> fresh_octants_;
};

}  // namespace rhmap
