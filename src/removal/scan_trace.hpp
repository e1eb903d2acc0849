// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "region_map.hpp"
#include "scan_octants.hpp"

namespace rhmap {

/// The cubes of a scan in one column of regions: the heights of ^{2d}S^W, Eq. (7).
struct ScanColumn {
  Column* column = nullptr;
  int z_min = 1 << 16, z_max = -1;  ///< keys of the lowest and the highest cube
  int points = 0;
  bool max_ring = false;      ///< a point of the scan's highest ring is in it
  bool bulge_dented = false;  ///< a point of P_sup or P_inf is in it
};

/// An octant that a scan has hit, and where it is.
struct TracedOctant {
  Octant* octant = nullptr;
  Region* region = nullptr;
  OcTreeKey corner;          ///< its lowest cube
  std::uint16_t number = 0;  ///< in the region
};

/// What a scan has touched. It lies all over the memory: who visits it is given each thing some time after it was asked
/// for.
struct ScanTrace {
  std::uint32_t scan = 0;             ///< its number, from 1
  std::vector<ScanColumn> columns;    ///< as far as contexts reach
  std::vector<Region*> regions;       ///< all with a hit
  std::vector<TracedOctant> octants;  ///< all with a hit

  /// Visits the regions, and has asked for their hit octants, too.
  template <class F>
  void forEachRegion(F&& visit) const {
    for (std::size_t i = 0; i < regions.size(); ++i) {
      if (i + 2 * kAhead < regions.size()) Region::prefetch(regions[i + 2 * kAhead]);
      if (i + kAhead < regions.size()) prefetchOctants(*regions[i + kAhead], regions[i + kAhead]->hit_octants);
      visit(*regions[i]);
    }
  }

  /// Visits the octants, and has asked for what askFor(TracedOctant) asks for.
  template <class AskFor, class F>
  void forEachOctant(AskFor&& askFor, F&& visit) const {
    for (std::size_t i = 0; i < octants.size(); ++i) {
      if (i + 2 * kAhead < octants.size()) {
        __builtin_prefetch(octants[i + 2 * kAhead].octant);
        askFor(octants[i + 2 * kAhead]);
      }
      visit(octants[i]);
    }
  }
  template <class F>
  void forEachOctant(F&& visit) const {
    forEachOctant([](const TracedOctant&) {}, visit);
  }

 private:
  static constexpr std::size_t kAhead = 10;
};

struct TraceConfig {
  double reach = 50;        ///< of the contexts [m]
  double resolution = 0.1;  ///< edge of a cube [m]
  int firm = 3;             ///< hits that make a cube firm
  bool insert = true;       ///< puts the cubes into the map, and does not only mark what was hit
};

/// Marks the cubes of a scan in the regions: Octant::hit and, if they are to be inserted, what follows from it. `trace`
/// may be that of another scan, whose memory it keeps.
void traceScan(RegionMap& map, const ScanOctants& octants, const OcTreeKey& sensor, std::uint32_t scan,
               const TraceConfig& config, ScanTrace& trace);

/// The columns of a trace around the sensor, by position.
class ColumnGrid {
 public:
  ColumnGrid(const RegionMap& map, const OcTreeKey& sensor, double reach, double resolution);

  /// Where the number of a column stands, below 0 if it has none; null outside of the grid.
  std::int32_t* at(int x, int y) {
    x -= x0_, y -= y0_;
    if (x < 0 || y < 0 || x >= side_ || y >= side_) return nullptr;
    return &index_[static_cast<std::size_t>(y * side_ + x)];
  }

 private:
  int half_, side_, x0_, y0_;
  std::vector<std::int32_t> index_;
};

}  // namespace rhmap
