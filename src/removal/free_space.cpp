// SPDX-License-Identifier: BSD-3-Clause
#include "free_space.hpp"

#include <algorithm>
#include <cmath>

namespace rhmap {
namespace {

constexpr int kBelow = 28;  // cells of the window below the sensor; the other 36 are above

std::uint64_t nameOf(int x, int y) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 | static_cast<std::uint32_t>(y);
}


std::uint64_t shifted(std::uint64_t word, int by) {
  return by >= 64 || by <= -64 ? 0 : by >= 0 ? word >> by : word << -by;
}

/// The cells of bit-sliced counters that have counted to at least `n`.
template <std::size_t N>
std::uint64_t atLeast(const std::array<std::uint64_t, N>& planes, unsigned n) {
  std::uint64_t larger = 0, equal = ~std::uint64_t{0};
  for (std::size_t i = N; i-- > 0;) {
    if (n >> i & 1) {
      equal &= planes[i];
    } else {
      larger |= equal & planes[i];
      equal &= ~planes[i];
    }
  }
  return larger | equal;
}

template <std::size_t N>
void count(std::array<std::uint64_t, N>& planes, std::uint64_t which) {
  std::uint64_t full = ~std::uint64_t{0};
  for (std::uint64_t plane : planes) full &= plane;
  std::uint64_t carry = which & ~full;
  for (std::uint64_t& plane : planes) {
    const std::uint64_t next = plane & carry;
    plane ^= carry;
    carry = next;
  }
}

}  // namespace

CellGrid CellGrid::eroded() const {
  CellGrid result(x0_, y0_, z0_, side_);
  for (int y = 1; y + 1 < side_; ++y) {
    for (int x = 1; x + 1 < side_; ++x) {
      std::uint64_t all = word(x, y);
      if (all == 0) continue;
      for (int dy = -1; dy <= 1; ++dy) all &= word(x - 1, y + dy) & word(x, y + dy) & word(x + 1, y + dy);
      result.word(x, y) = all & all << 1 & all >> 1;
    }
  }
  return result;
}

CellGrid CellGrid::dilated() const {
  CellGrid result(x0_, y0_, z0_, side_);
  for (int y = 1; y + 1 < side_; ++y) {
    for (int x = 1; x + 1 < side_; ++x) {
      std::uint64_t any = word(x, y);
      if (any == 0) continue;
      any |= any << 1 | any >> 1;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) result.word(x + dx, y + dy) |= any;
    }
  }
  return result;
}

void FreeSpace::Tile::moveTo(int z) {
  if (z == z0) return;
  for (CellColumn& column : columns) {
    column.is_void = shifted(column.is_void, z - z0);
    for (std::uint64_t& plane : column.crossed) plane = shifted(plane, z - z0);
  }
  z0 = z;
}

FreeSpace::FreeSpace(const VoidConfig& config, double cube)
    : config_(config), cube_(cube), shift_(config.cell > 3 * cube ? 2 : 1), cells_(1 << shift_) {}

FreeSpace::~FreeSpace() {
  tiles_.forEach([](Tile& tile) { delete &tile; });
}

FreeSpace::Tile& FreeSpace::tileAt(int x, int y, int z0) {
  Tile* tile = tiles_.find(nameOf(x, y));
  if (tile == nullptr) {
    tile = new Tile{.x = x, .y = y, .z0 = z0};
    tiles_.insert(nameOf(x, y), tile);
  }
  tile->moveTo(z0);
  return *tile;
}

void FreeSpace::castRays(const RegionMap& map, const ScanTrace& trace, const std::array<float, 3>& sensor) {
  const float cells_per_metre = static_cast<float>(1 / (cells_ * cube_));
  const float reach = static_cast<float>(config_.max_range) * cells_per_metre;
  const float surface = static_cast<float>(config_.surface) * cells_per_metre;
  std::array<float, 3> from;
  for (std::size_t i = 0; i < 3; ++i) from[i] = (sensor[i] + 0.5F) / static_cast<float>(cells_);

  // The end of each hit cell's ray: its hit cube nearest to the cell's first. And what else is surface.
  struct End {
    std::array<float, 3> to;
    float length;
    bool ground;
  };
  std::vector<End> ends;
  ends.reserve(16384);
  for (const Region* region : trace.regions) {
    for (int o = 0; o < map.octants(); ++o) {
      const Octant& octant = region->octants[static_cast<std::size_t>(o)];
      if (octant.hit == 0) continue;
      const OcTreeKey octant_corner = map.cornerOf(*region, o);
      forEachCell(octant.hit, octant_corner, shift_, [&](const OcTreeKey& corner, std::uint64_t hit, int) {
        hit_.set(corner[0] >> shift_, corner[1] >> shift_, corner[2] >> shift_);
        const OcTreeKey cube = cubeOf(octant_corner, std::countr_zero(hit));
        End end;
        float squared = 0;
        for (unsigned i = 0; i < 3; ++i) {
          end.to[i] = (static_cast<float>(cube[i]) + 0.5F) / static_cast<float>(cells_);
          squared += (end.to[i] - from[i]) * (end.to[i] - from[i]);
        }
        end.length = std::sqrt(squared);
        if (end.length > reach || end.length < 1) return;
        end.ground = (octant.ground & hit) != 0;
        const float t = 1 - surface / end.length;
        hit_.set(static_cast<int>(from[0] + t * (end.to[0] - from[0])), static_cast<int>(from[1] + t * (end.to[1] - from[1])),
                 static_cast<int>(from[2] + t * (end.to[2] - from[2])));
        ends.push_back(end);
      });
    }
  }

  // Amanatides and Woo, over words of 64 cells in z.
  const int side = crossed_.side();
  for (const End& end : ends) {
    float limit = 1;
    if (end.ground) {  // the last metres of a grazing ray run inside the ground's own cells
      const float sine = std::max(std::fabs(end.to[2] - from[2]) / end.length, 1e-3F);
      limit = 1 - std::min(5.0F, 0.3F / sine) * cells_per_metre / end.length;
      if (limit <= 0) continue;
    }
    int cell[3], step[3];
    float next[3], delta[3];
    for (unsigned i = 0; i < 3; ++i) {
      const float d = end.to[i] - from[i];
      cell[i] = static_cast<int>(from[i]);
      step[i] = d < 0 ? -1 : 1;
      delta[i] = d == 0 ? 1e30F : std::fabs(1 / d);
      const float border = static_cast<float>(cell[i] + (d < 0 ? 0 : 1));
      next[i] = d == 0 ? 1e30F : (border - from[i]) / d;
    }
    int x = cell[0] - crossed_.x0(), y = cell[1] - crossed_.y0(), z = cell[2] - crossed_.z0();
    for (;;) {
      if (x < 0 || y < 0 || x >= side || y >= side || z < 0 || z >= 64) break;
      const std::uint64_t bit = std::uint64_t{1} << z;
      if ((hit_.word(x, y) & bit) != 0) break;
      crossed_.word(x, y) |= bit;
      if (next[0] <= next[1] && next[0] <= next[2]) {
        if (next[0] > limit) break;
        next[0] += delta[0], x += step[0];
      } else if (next[1] <= next[2]) {
        if (next[1] > limit) break;
        next[1] += delta[1], y += step[1];
      } else {
        if (next[2] > limit) break;
        next[2] += delta[2], z += step[2];
      }
    }
  }
}

void FreeSpace::revert(const RegionMap& map, const ScanTrace& trace) {
  for (Region* region : trace.regions) {
    for (int o = 0; o < map.octants(); ++o) {
      Octant& octant = region->octants[static_cast<std::size_t>(o)];
      if (octant.hit == 0) continue;
      forEachCell(octant.hit, map.cornerOf(*region, o), shift_, [&](const OcTreeKey& corner, std::uint64_t, int cell) {
      const int x = (corner[0] >> shift_) - voids_.x0(), y = (corner[1] >> shift_) - voids_.y0(),
                z = (corner[2] >> shift_) - voids_.z0();
      if (x < 1 || y < 1 || x + 1 >= voids_.side() || y + 1 >= voids_.side() || z < 0 || z >= 64) return;
      Tile& tile = tileAt((x + voids_.x0()) >> 3, (y + voids_.y0()) >> 3, voids_.z0());
      const CellColumn& column = tile.columns[static_cast<std::size_t>(((y + voids_.y0()) & 7) * 8 + ((x + voids_.x0()) & 7))];
      const bool crossed_since = (atLeast(column.crossed, 1) >> z & 1) != 0;
      auto& in_a_row = octant.hit_in_a_row[static_cast<std::size_t>(cell)];
      in_a_row = crossed_since ? std::uint8_t{1} : static_cast<std::uint8_t>(in_a_row + (in_a_row < 255));
      if (in_a_row < config_.tau_r || (column.is_void >> z & 1) == 0) return;
      const std::uint64_t around = (z > 0 ? std::uint64_t{7} << (z - 1) : std::uint64_t{3});
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int cx = x + dx + voids_.x0(), cy = y + dy + voids_.y0();
          Tile& other = tileAt(cx >> 3, cy >> 3, voids_.z0());
          other.columns[static_cast<std::size_t>((cy & 7) * 8 + (cx & 7))].is_void &= ~around;
        }
      }
      });
    }
  }
}

void FreeSpace::observe(const RegionMap& map, const ScanTrace& trace, const std::array<float, 3>& sensor) {
  const int radius = static_cast<int>(std::ceil(config_.max_range / (cells_ * cube_))) + 2;
  const int sx = static_cast<int>(sensor[0]) >> shift_, sy = static_cast<int>(sensor[1]) >> shift_, sz = static_cast<int>(sensor[2]) >> shift_;
  // Snapped to tiles, so that each is looked up once.
  const int x0 = (sx - radius) & ~7, y0 = (sy - radius) & ~7, z0 = (sz - kBelow) & ~7;
  const int side = (2 * radius + 15) & ~7;
  hit_ = CellGrid(x0, y0, z0, side);
  crossed_ = CellGrid(x0, y0, z0, side);
  voids_ = CellGrid(x0, y0, z0, side);
  castRays(map, trace, sensor);
  revert(map, trace);
  const CellGrid clear = crossed_.eroded();
  for (int ty = 0; ty < side; ty += 8) {
    for (int tx = 0; tx < side; tx += 8) {
      Tile* tile = tiles_.find(nameOf((x0 + tx) >> 3, (y0 + ty) >> 3));
      if (tile == nullptr) {
        bool any = false;
        for (int y = 0; y < 8; ++y)
          for (int x = 0; x < 8; ++x) any = any || crossed_.word(tx + x, ty + y) != 0;
        if (!any) continue;
        tile = &tileAt((x0 + tx) >> 3, (y0 + ty) >> 3, z0);
      }
      tile->moveTo(z0);
      for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
          CellColumn& column = tile->columns[static_cast<std::size_t>(y * 8 + x)];
          const std::uint64_t hit = hit_.word(tx + x, ty + y);
          for (std::uint64_t& plane : column.crossed) plane &= ~hit;
          count(column.crossed, crossed_.word(tx + x, ty + y));
          column.is_void |= clear.word(tx + x, ty + y) & atLeast(column.crossed, static_cast<unsigned>(config_.tau_f));
          voids_.word(tx + x, ty + y) = column.is_void;
        }
      }
    }
  }
}

void FreeSpace::forgetBeyond(const OcTreeKey& centre, int distance) {
  std::vector<Tile*> far;
  tiles_.forEach([&](Tile& tile) {
    const int dx = tile.x * 8 * cells_ - centre[0], dy = tile.y * 8 * cells_ - centre[1];
    if (std::max(std::abs(dx), std::abs(dy)) > distance) far.push_back(&tile);
  });
  for (Tile* tile : far) {
    tiles_.erase(nameOf(tile->x, tile->y));
    delete tile;
  }
}

}  // namespace rhmap
