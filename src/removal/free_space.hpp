// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "cell_counters.hpp"
#include "cell_grid.hpp"
#include "region_map.hpp"
#include "rhmap/core/block_index.hpp"
#include "rhmap/core/record_pool.hpp"
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

  /// Takes in a scan whose hits are marked. `sensor` in keys (a cube's centre is its key).
  void observe(const ScanTrace& trace, const std::array<float, 3>& sensor);

  /// Whether a cell around the sensor is void, as of the last scan.
  bool isVoid(int x, int y, int z) const {
    return holds(x, y, z, [](const auto& column) { return column.is_void; });
  }
  /// Whether it would be, were the cells on one of its sides crossed, too.
  bool isOpen(int x, int y, int z) const {
    return holds(x, y, z, [](const auto& column) { return column.is_open; });
  }
  /// Whether rays have crossed the cell in more than so many scans, as far as those tell that are followed (seven of
  /// these stand for any number).
  bool isCrossed(int x, int y, int z, double scans) const {
    const unsigned followed = std::min(static_cast<unsigned>(scans / config_.interval) + 1, kMostCrossings);
    return holds(x, y, z, [followed](const auto& column) { return column.crossings.atLeast(followed); });
  }
  /// Asks for what is known of a cell around the sensor (see BlockIndex::prefetch).
  [[gnu::always_inline]] void prefetch(int x, int y) const {
    x -= ends_.x0(), y -= ends_.y0();
    if (x < 0 || y < 0 || x >= ends_.side() || y >= ends_.side()) return;
    if (const Tile* tile = tileAt(x, y)) __builtin_prefetch(&columnOf(*tile, x, y));
  }
  /// The cells that the last scan has hit.
  const CellGrid& ends() const { return ends_; }
  /// From the sensor to the middle of a column of cells [m].
  double distance(int x, int y) const {
    return width() * std::hypot(static_cast<float>(x) + 0.5F - from_[0], static_cast<float>(y) + 0.5F - from_[1]);
  }
  /// A cell is 2^shift cubes wide.
  int shift() const { return shift_; }

  /// Forgets what is farther than this many cubes (along an axis) from a cube.
  void forgetBeyond(const OcTreeKey& centre, int distance);

  std::size_t memoryUsage() const { return tiles_.memoryUsage() + tiles_.size() * sizeof(Tile); }

 private:
  static constexpr unsigned kMostCrossings = Counters<3>::kMost;

  /// 64 cells above each other. One line of the cache.
  struct alignas(64) CellColumn {
    std::uint64_t is_void = 0;
    std::uint64_t is_open = 0;  // void but for one side
    Counters<3> crossed;        // followed scans since the last hit
    Counters<3> crossings;      // followed scans, ever
  };
  /// 8 x 8 columns of cells; what is kept from scan to scan.
  struct Tile {
    int x, y;  // of the first cell, / 8
    int z0;    // of the lowest cell
    std::array<CellColumn, 64> columns{};
    std::array<Counters<8>, 64> hits{};  // followed scans that have hit the cell since a ray crossed it

    void moveTo(int z);
  };
  /// By place in the window; null if nothing is known there.
  const Tile* tileAt(int x, int y) const {
    return window_[static_cast<std::size_t>((y >> 3) * (ends_.side() >> 3) + (x >> 3))];
  }
  static const CellColumn& columnOf(const Tile& tile, int x, int y) {
    return tile.columns[static_cast<std::size_t>((y & 7) * 8 + (x & 7))];
  }
  /// What cellsOf(column) says of a cell around the sensor; no of others.
  template <class CellsOf>
  bool holds(int x, int y, int z, CellsOf&& cellsOf) const {
    x -= ends_.x0(), y -= ends_.y0();
    if (x < 0 || y < 0 || x >= ends_.side() || y >= ends_.side()) return false;
    const Tile* tile = tileAt(x, y);
    if (tile == nullptr || z < tile->z0 || z >= tile->z0 + 64) return false;
    return (cellsOf(columnOf(*tile, x, y)) >> (z - tile->z0) & 1) != 0;
  }
  /// Of a cell [m].
  double width() const { return cube_ * (1 << shift_); }
  void openWindow(const std::array<int, 3>& cell);
  template <class F, class... Grids>
  void forEachColumn(F&& visit, const Grids&... grids);
  void markHits(const ScanTrace& trace, VoidRays* rays);
  void fill(const CellGrid& cells);
  void forgetHit();
  void update();

  VoidConfig config_;
  double cube_;
  int shift_;
  std::array<float, 3> from_{};  // the sensor, in cells
  CellGrid ends_;                // of the scan: where its points are
  CellGrid hit_;                 // and where with noise the surface may be
  CellGrid crossed_;             // by its rays
  CellGrid clear_, open_;        // and all of a cell's neighbours with it, or but for one side
  CellGrid stayed_, filled_;     // cells that are ordinary again, and those around them
  VoidRays rays_;                // kept for their memory
  std::vector<Tile*> window_;    // those around the sensor, row by row; null where there is none
  BlockIndex<Tile> tiles_;
  static_assert(std::is_trivially_destructible_v<Tile>);
  PiecePool pieces_{true};
  RecordPool tile_pool_{pieces_, {.bytes = sizeof(Tile)}};
};

}  // namespace rhmap
