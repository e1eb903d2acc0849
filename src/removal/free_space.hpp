// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "cell_counters.hpp"
#include "cell_grid.hpp"
#include "region_map.hpp"
#include "rhmap/core/block_index.hpp"
#include "rhmap/removal/removal_config.hpp"
#include "scan_trace.hpp"
#include "void_rays.hpp"

namespace rhmap {

/// Visits the cells of an octant (2^shift cubes an axis: all of it, or its eighths) that hold any of these cubes:
/// lowest cube of the cell, its cubes.
template <class F>
void forEachCell(std::uint64_t cubes, const OcTreeKey& corner, int shift, F&& visit) {
  if (cubes == 0) return;
  if (shift == 2) {
    visit(corner, cubes);
    return;
  }
  for (std::size_t i = 0; i < 8; ++i) {
    const std::uint64_t some = cubes & std::uint64_t{0xff} << (8 * i);
    if (some != 0) visit(cubeOf(corner, static_cast<int>(8 * i)), some);
  }
}

/// The void: cells that rays have crossed together with all their neighbours, in several scans since they were last
/// hit. What is hit in such a cell moves.
class FreeSpace {
 public:
  /// `cube`: edge of a cube [m].
  FreeSpace(const VoidConfig& config, double cube);
  FreeSpace(const FreeSpace&) = delete;
  FreeSpace& operator=(const FreeSpace&) = delete;
  ~FreeSpace();

  /// Takes in a scan whose hits are marked. `sensor` in keys (a cube's centre is its key).
  void observe(const RegionMap& map, const ScanTrace& trace, const std::array<float, 3>& sensor);

  /// The void around the sensor, as of the last scan.
  const CellGrid& voids() const { return voids_; }
  /// Cells that would be void, were those on one of their sides crossed, too.
  const CellGrid& open() const { return open_; }
  /// The cells that the last scan has hit.
  const CellGrid& ends() const { return ends_; }
  /// A cell is 2^shift cubes wide.
  int shift() const { return shift_; }

  /// Forgets what is farther than this many cubes (along an axis) from a cube.
  void forgetBeyond(const OcTreeKey& centre, int distance);

  std::size_t memoryUsage() const { return tiles_.memoryUsage() + tiles_.size() * sizeof(Tile); }

 private:
  /// 64 cells above each other.
  struct CellColumn {
    std::uint64_t is_void = 0;
    std::uint64_t is_open = 0;  // void but for one side
    Counters<3> crossed;        // scans since the last hit
  };
  /// 8 x 8 columns of cells; what is kept from scan to scan.
  struct Tile {
    int x, y;  // of the first cell, / 8
    int z0;    // of the lowest cell
    std::array<CellColumn, 64> columns{};
    std::array<Counters<8>, 64> hits{};  // scans that have hit the cell since a ray crossed it

    void moveTo(int z);
  };
  template <class F>
  void forEachTile(F&& visit);
  void markHits(const RegionMap& map, const ScanTrace& trace, const std::array<float, 3>& from, VoidRays& rays);
  CellGrid stayed();
  void update();

  VoidConfig config_;
  double cube_;
  int shift_;
  CellGrid ends_;     // of the scan: where its points are
  CellGrid hit_;      // and where with noise the surface may be
  CellGrid crossed_;  // by its rays
  CellGrid voids_, open_;
  BlockIndex<Tile> tiles_;
};

}  // namespace rhmap
