// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "region_map.hpp"
#include "rhmap/removal/removal_config.hpp"
#include "scan_insertion.hpp"

namespace rhmap {

/// One bit for each cell of free space (an octant of 4 x 4 x 4 cubes) around the sensor: a word of 64 cells in z for each
/// (x, y).
class CellGrid {
 public:
  CellGrid() = default;
  CellGrid(int x0, int y0, int z0, int side)
      : x0_(x0), y0_(y0), z0_(z0), side_(side), words_(static_cast<std::size_t>(side * side), 0) {}

  int x0() const { return x0_; }
  int y0() const { return y0_; }
  int z0() const { return z0_; }
  int side() const { return side_; }

  std::uint64_t& word(int x, int y) { return words_[static_cast<std::size_t>(y * side_ + x)]; }
  std::uint64_t word(int x, int y) const { return words_[static_cast<std::size_t>(y * side_ + x)]; }

  /// By the cell's own coordinates; false outside.
  bool at(int x, int y, int z) const {
    x -= x0_, y -= y0_, z -= z0_;
    return x >= 0 && y >= 0 && x < side_ && y < side_ && z >= 0 && z < 64 && (word(x, y) >> z & 1) != 0;
  }
  void set(int x, int y, int z) {
    x -= x0_, y -= y0_, z -= z0_;
    if (x >= 0 && y >= 0 && x < side_ && y < side_ && z >= 0 && z < 64) word(x, y) |= std::uint64_t{1} << z;
  }

  /// The cells whose 26 neighbours are all set as well.
  CellGrid eroded() const;
  /// The cells that are set or next to one that is.
  CellGrid dilated() const;

 private:
  int x0_ = 0, y0_ = 0, z0_ = 0, side_ = 0;
  std::vector<std::uint64_t> words_;
};

/// Visits the cells of an octant that have any of these cubes: their lowest cube, their cubes, and their number.
template <class F>
void forEachCell(std::uint64_t cubes, const OcTreeKey& corner, int shift, F&& visit) {
  if (shift == 2) {
    if (cubes != 0) visit(corner, cubes, 0);
    return;
  }
  for (int i = 0; i < 8; ++i)
    if (const std::uint64_t some = cubes & std::uint64_t{0xff} << (8 * i); some != 0) visit(cubeOf(corner, 8 * i), some, i);
}

/// Where there is nothing, for good: cells that rays have crossed with all their neighbours, scan after scan.
class FreeSpace {
 public:
  FreeSpace(const VoidConfig& config, double cube);
  FreeSpace(const FreeSpace&) = delete;
  FreeSpace& operator=(const FreeSpace&) = delete;
  ~FreeSpace();

  /// Takes in a scan whose hits are marked. `sensor` in keys (a cube's centre is its key).
  void observe(const RegionMap& map, const ScanTrace& trace, const std::array<float, 3>& sensor);

  /// The void cells around the sensor, as of the last scan.
  const CellGrid& voids() const { return voids_; }
  int shift() const { return shift_; }

  /// Forgets what is farther than this many cubes from a cube.
  void forgetBeyond(const OcTreeKey& centre, int distance);

 private:
  static constexpr int kPlanes = 3;  // of the counter: up to 7
  struct CellColumn {
    std::uint64_t is_void = 0;
    std::array<std::uint64_t, kPlanes> crossed{};  // scans since the last hit, bit-sliced, saturating
  };
  struct Tile {
    int x, y;      // 8 x 8 columns
    int z0;
    std::array<CellColumn, 64> columns{};
    void moveTo(int z);
  };

  Tile& tileAt(int x, int y, int z0);
  void castRays(const RegionMap& map, const ScanTrace& trace, const std::array<float, 3>& sensor);
  void revert(const RegionMap& map, const ScanTrace& trace);

  VoidConfig config_;
  double cube_;
  int shift_, cells_;
  CellGrid hit_, crossed_, voids_;
  BlockIndex<Tile> tiles_;
};

}  // namespace rhmap
