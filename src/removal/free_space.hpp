// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cell_grid.hpp"
#include "region_map.hpp"
#include "rhmap/core/block_index.hpp"
#include "rhmap/removal/removal_config.hpp"
#include "scan_trace.hpp"

namespace rhmap {

/// Visits the cells of an octant (2^shift cubes an axis: all of it, or its eighths) that hold any of these cubes:
/// lowest cube of the cell, its cubes, its number.
template <class F>
void forEachCell(std::uint64_t cubes, const OcTreeKey& corner, int shift, F&& visit) {
  if (cubes == 0) return;
  if (shift == 2) {
    visit(corner, cubes, std::size_t{0});
    return;
  }
  for (std::size_t i = 0; i < 8; ++i) {
    const std::uint64_t some = cubes & std::uint64_t{0xff} << (8 * i);
    if (some != 0) visit(cubeOf(corner, static_cast<int>(8 * i)), some, i);
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
  /// A cell is 2^shift cubes wide.
  int shift() const { return shift_; }

  /// Forgets what is farther than this many cubes (along an axis) from a cube.
  void forgetBeyond(const OcTreeKey& centre, int distance);

  std::size_t memoryUsage() const { return tiles_.memoryUsage() + tiles_.size() * sizeof(Tile); }

 private:
  /// 64 cells above each other.
  struct CellColumn {
    std::uint64_t is_void = 0;
    std::uint64_t is_open = 0;               // void but for one side
    std::array<std::uint64_t, 3> crossed{};  // scans since the last hit: bit-sliced counters up to 7
  };
  /// 8 x 8 columns of cells; what is kept from scan to scan.
  struct Tile {
    int x, y;  // of the first cell, / 8
    int z0;    // of the lowest cell
    std::array<CellColumn, 64> columns{};

    CellColumn& at(int cx, int cy) { return columns[static_cast<std::size_t>((cy & 7) * 8 + (cx & 7))]; }
    void moveTo(int z);
  };
  /// A ray to be followed, in cells.
  struct Ray {
    std::array<float, 3> to;
    float share;  // of it that is followed
  };

  Tile& tileAt(int x, int y);
  void markHits(const RegionMap& map, const ScanTrace& trace, const std::array<float, 3>& from, std::vector<Ray>& rays);
  void follow(const std::array<float, 3>& from, const Ray& ray);
  void revert(const RegionMap& map, const ScanTrace& trace);
  void update();

  VoidConfig config_;
  double cube_;
  int shift_;
  CellGrid hit_, crossed_;  // of the scan
  CellGrid voids_, open_;
  BlockIndex<Tile> tiles_;
};

}  // namespace rhmap
