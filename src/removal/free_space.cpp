// SPDX-License-Identifier: BSD-3-Clause
#include "free_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>
#include <utility>

namespace rhmap {
namespace {

constexpr int kBelow = 28;             // cells of the window below the sensor; the other 36 are above
constexpr float kGrazing = 0.3F;       // ground rays end where they are this high above their end [m]
constexpr float kLongestGraze = 5.0F;  // but lose no more than this [m]

std::uint64_t nameOf(int x, int y) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 | static_cast<std::uint32_t>(y);
}

}  // namespace

FreeSpace::FreeSpace(const VoidConfig& config, double cube)
    : config_(config), cube_(cube), shift_(config.cell > 3 * cube ? 2 : 1) {}

/// The window follows the sensor up and down.
void FreeSpace::Tile::moveTo(int z) {
  if (z == z0) return;
  for (CellColumn& column : columns) {
    column.is_void = shifted(column.is_void, z - z0);
    column.is_open = shifted(column.is_open, z - z0);
    column.crossed.shift(z - z0);
    column.crossings.shift(z - z0);
  }
  for (Counters<8>& counters : hits) counters.shift(z - z0);
  z0 = z;
}

/// Around the sensor's cell, snapped to tiles.
void FreeSpace::openWindow(const std::array<int, 3>& cell) {
  const int radius = static_cast<int>(std::ceil(config_.max_range / width())) + 2;
  const int x0 = (cell[0] - radius) & ~7, y0 = (cell[1] - radius) & ~7, z0 = (cell[2] - kBelow) & ~7;
  const int side = (2 * radius + 15) & ~7;
  const bool has_moved = x0 != ends_.x0() || y0 != ends_.y0() || side != ends_.side();
  for (CellGrid* grid : {&ends_, &hit_}) grid->reset(x0, y0, z0, side);
  if (!has_moved) return;
  window_.clear();
  for (int y = y0 >> 3; y < (y0 + side) >> 3; ++y)
    for (int x = x0 >> 3; x < (x0 + side) >> 3; ++x) window_.push_back(tiles_.find(nameOf(x, y)));
}

/// Visits the columns for which one of some grids has something: visit(tile, i, x, y), with the tile's column `i` at
/// (x, y) in the window. Which those are is hard to guess, and is found out without branches.
template <class F, class... Grids>
void FreeSpace::forEachColumn(F&& visit, const Grids&... grids) {
  std::size_t number = 0;
  for (int ty = 0; ty < ends_.side(); ty += 8) {
    for (int tx = 0; tx < ends_.side(); tx += 8, ++number) {
      if (!(grids.mayHold(tx, ty) || ...)) continue;
      std::uint64_t columns = 0;
      for (int i = 0; i < 64; ++i) columns |= std::uint64_t{(grids.word(tx + i % 8, ty + i / 8) | ...) != 0} << i;
      if (columns == 0) continue;
      Tile*& tile = window_[number];
      if (tile == nullptr) {
        const int x = (ends_.x0() + tx) >> 3, y = (ends_.y0() + ty) >> 3;
        tile = new (tile_pool_.allocate()) Tile{.x = x, .y = y, .z0 = ends_.z0()};
        tiles_.insert(nameOf(x, y), tile);
      }
      tile->moveTo(ends_.z0());
      forEachBit(columns, [&](int i) { __builtin_prefetch(&tile->columns[static_cast<std::size_t>(i)]); });
      forEachBit(columns, [&](int i) { visit(*tile, static_cast<std::size_t>(i), tx + i % 8, ty + i / 8); });
    }
  }
}

void FreeSpace::observe(const ScanTrace& trace, const std::array<float, 3>& sensor) {
  std::array<int, 3> cell;
  for (std::size_t i = 0; i < 3; ++i) {
    from_[i] = (sensor[i] + 0.5F) / static_cast<float>(1 << shift_);
    cell[i] = static_cast<int>(from_[i]);
  }
  openWindow(cell);
  if (trace.scan % static_cast<std::uint32_t>(config_.interval) == 0) {
    rays_.clear();
    crossed_.resetTo(hit_);
    markHits(trace, &rays_);
    followRays(from_, rays_, hit_, crossed_);
    crossed_.closeGaps(hit_);
    update();
  } else {
    markHits(trace, nullptr);
    forgetHit();
  }
}

/// The hit cells, and one ray to each for those who want to follow them (not null).
void FreeSpace::markHits(const ScanTrace& trace, VoidRays* rays) {
  const auto cells_per_metre = static_cast<float>(1 / width());
  const float reach = static_cast<float>(config_.max_range) * cells_per_metre;
  const float surface = static_cast<float>(config_.surface) * cells_per_metre;
  trace.forEachOctant([&](const TracedOctant& at) {
    const Octant& octant = *at.octant;
    forEachCell(octant.hit, at.corner, shift_, [&](const OcTreeKey& cell, std::uint64_t hit) {
      ends_.set(cell[0] >> shift_, cell[1] >> shift_, cell[2] >> shift_);
      hit_.set(cell[0] >> shift_, cell[1] >> shift_, cell[2] >> shift_);
      const OcTreeKey cube = cubeOf(at.corner, std::countr_zero(hit));
      std::array<float, 3> to;
      float squared = 0;
      for (unsigned i = 0; i < 3; ++i) {
        to[i] = (static_cast<float>(cube[i]) + 0.5F) / static_cast<float>(1 << shift_);
        squared += (to[i] - from_[i]) * (to[i] - from_[i]);
      }
      const float length = std::sqrt(squared);
      if (length > reach || length < 1) return;
      const float t = 1 - surface / length;  // with noise, the surface may be here
      hit_.set(static_cast<int>(from_[0] + t * (to[0] - from_[0])), static_cast<int>(from_[1] + t * (to[1] - from_[1])),
               static_cast<int>(from_[2] + t * (to[2] - from_[2])));
      if (rays == nullptr) return;
      float share = 1;
      if ((octant.ground & hit) != 0) {  // the last metres of a grazing ray run inside the ground's own cells
        const float sine = std::max(std::fabs(to[2] - from_[2]) / length, 1e-3F);
        share = 1 - std::min(kLongestGraze, kGrazing / sine) * cells_per_metre / length;
      }
      if (share > 0) rays->push(to, share);
    });
  });
}

/// These cells and those around them are void no longer.
void FreeSpace::fill(const CellGrid& cells) {
  if (cells.empty()) return;
  filled_ = cells.dilated(std::move(filled_));
  std::size_t number = 0;
  for (int ty = 0; ty < filled_.side(); ty += 8) {
    for (int tx = 0; tx < filled_.side(); tx += 8, ++number) {
      Tile* tile = window_[number];
      if (tile == nullptr) continue;
      tile->moveTo(filled_.z0());
      if (!filled_.mayHold(tx, ty)) continue;
      for (int i = 0; i < 64; ++i) {
        CellColumn& column = tile->columns[static_cast<std::size_t>(i)];
        column.is_void &= ~filled_.word(tx + i % 8, ty + i / 8);
        column.is_open &= ~filled_.word(tx + i % 8, ty + i / 8);
      }
    }
  }
}

/// Where something is, the count of scans that have crossed begins again.
void FreeSpace::forgetHit() {
  forEachColumn([&](Tile& tile, std::size_t i, int x, int y) { tile.columns[i].crossed.reset(hit_.word(x, y)); }, hit_);
}

/// Takes the scan's cells into the tiles' counters, finds the void, and what has come to stay there: cells that are hit
/// again and again, and that no ray crosses any more.
void FreeSpace::update() {
  clear_ = crossed_.eroded(std::move(clear_));
  open_ = crossed_.erodedToOneSide(std::move(open_));
  stayed_.resetTo(ends_);
  forEachColumn(
      [&](Tile& tile, std::size_t i, int x, int y) {
        CellColumn& column = tile.columns[i];
        if (const std::uint64_t ends = ends_.word(x, y); ends != 0) {
          Counters<8>& hits = tile.hits[i];
          hits.reset(ends & column.crossed.atLeast(1));
          hits.countUp(ends);
          stayed_.touch(x, y) =
              ends & (column.is_void | column.is_open) & hits.atLeast(static_cast<unsigned>(config_.tau_r));
        }
        const std::uint64_t crossed = crossed_.word(x, y);
        column.crossed.reset(hit_.word(x, y));
        column.crossed.countUp(crossed);
        column.crossings.countUp(crossed);
        const std::uint64_t often = column.crossed.atLeast(static_cast<unsigned>(config_.tau_f));
        column.is_void |= clear_.word(x, y) & often;
        column.is_open |= open_.word(x, y) & often;
      },
      crossed_, hit_);
  fill(stayed_);
}

void FreeSpace::forgetBeyond(const OcTreeKey& centre, int distance) {
  std::vector<Tile*> far;
  const int width = 8 << shift_;
  tiles_.forEach([&](Tile& tile) {
    const int dx = tile.x * width + width / 2 - centre[0], dy = tile.y * width + width / 2 - centre[1];
    if (std::max(std::abs(dx), std::abs(dy)) > distance) far.push_back(&tile);
  });
  for (Tile* tile : far) {
    tiles_.erase(nameOf(tile->x, tile->y));
    std::replace(window_.begin(), window_.end(), tile, static_cast<Tile*>(nullptr));
    tile_pool_.release(tile);
  }
}

}  // namespace rhmap
