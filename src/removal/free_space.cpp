// SPDX-License-Identifier: BSD-3-Clause
#include "free_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace rhmap {
namespace {

constexpr int kBelow = 28;             // cells of the window below the sensor; the other 36 are above
constexpr float kGrazing = 0.3F;       // ground rays end where they are this high above their end [m]
constexpr float kLongestGraze = 5.0F;  // but lose no more than this [m]
constexpr float kFar = 1e30F;

std::uint64_t nameOf(int x, int y) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 | static_cast<std::uint32_t>(y);
}

std::uint64_t shifted(std::uint64_t word, int by) {
  return by >= 64 || by <= -64 ? 0 : by >= 0 ? word >> by : word << -by;
}

using Counters = std::array<std::uint64_t, 3>;

/// The cells that have counted to at least `n`.
std::uint64_t atLeast(const Counters& planes, unsigned n) {
  std::uint64_t larger = 0, equal = ~std::uint64_t{0};
  for (std::size_t i = planes.size(); i-- > 0;) {
    if (n >> i & 1) {
      equal &= planes[i];
    } else {
      larger |= equal & planes[i];
      equal &= ~planes[i];
    }
  }
  return larger | equal;
}

/// Counts one more for these cells, up to 7.
void count(Counters& planes, std::uint64_t cells) {
  std::uint64_t carry = cells & ~(planes[0] & planes[1] & planes[2]);
  for (std::uint64_t& plane : planes) {
    const std::uint64_t next = plane & carry;
    plane ^= carry;
    carry = next;
  }
}

}  // namespace

FreeSpace::FreeSpace(const VoidConfig& config, double cube)
    : config_(config), cube_(cube), shift_(config.cell > 3 * cube ? 2 : 1) {}

FreeSpace::~FreeSpace() {
  tiles_.forEach([](Tile& tile) { delete &tile; });
}

/// The window follows the sensor up and down.
void FreeSpace::Tile::moveTo(int z) {
  if (z == z0) return;
  for (CellColumn& column : columns) {
    column.is_void = shifted(column.is_void, z - z0);
    column.is_open = shifted(column.is_open, z - z0);
    for (std::uint64_t& plane : column.crossed) plane = shifted(plane, z - z0);
  }
  z0 = z;
}

FreeSpace::Tile& FreeSpace::tileAt(int x, int y) {
  Tile* tile = tiles_.find(nameOf(x, y));
  if (tile == nullptr) {
    tile = new Tile{.x = x, .y = y, .z0 = voids_.z0()};
    tiles_.insert(nameOf(x, y), tile);
  }
  tile->moveTo(voids_.z0());
  return *tile;
}

void FreeSpace::observe(const RegionMap& map, const ScanTrace& trace, const std::array<float, 3>& sensor) {
  std::array<float, 3> from;
  std::array<int, 3> cell;
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] = (sensor[i] + 0.5F) / static_cast<float>(1 << shift_);
    cell[i] = static_cast<int>(from[i]);
  }
  // Snapped to tiles, so that each is looked up once.
  const int radius = static_cast<int>(std::ceil(config_.max_range / (cube_ * (1 << shift_)))) + 2;
  const int x0 = (cell[0] - radius) & ~7, y0 = (cell[1] - radius) & ~7, z0 = (cell[2] - kBelow) & ~7;
  const int side = (2 * radius + 15) & ~7;
  for (CellGrid* grid : {&hit_, &crossed_, &voids_, &open_}) grid->reset(x0, y0, z0, side);

  std::vector<Ray> rays;
  markHits(map, trace, from, rays);
  for (const Ray& ray : rays) follow(from, ray);
  revert(map, trace);
  update();
}

/// The hit cells, with one ray to each.
void FreeSpace::markHits(const RegionMap& map, const ScanTrace& trace, const std::array<float, 3>& from,
                         std::vector<Ray>& rays) {
  const auto cells_per_metre = static_cast<float>(1 / (cube_ * (1 << shift_)));
  const float reach = static_cast<float>(config_.max_range) * cells_per_metre;
  const float surface = static_cast<float>(config_.surface) * cells_per_metre;
  for (const Region* region : trace.regions) {
    region->forEachHitOctant([&](std::size_t o, const Octant& octant) {
      const OcTreeKey corner = map.cornerOf(*region, o);
      forEachCell(octant.hit, corner, shift_, [&](const OcTreeKey& cell, std::uint64_t hit, std::size_t) {
        hit_.set(cell[0] >> shift_, cell[1] >> shift_, cell[2] >> shift_);
        const OcTreeKey cube = cubeOf(corner, std::countr_zero(hit));
        Ray ray{.to = {}, .share = 1};
        float squared = 0;
        for (unsigned i = 0; i < 3; ++i) {
          ray.to[i] = (static_cast<float>(cube[i]) + 0.5F) / static_cast<float>(1 << shift_);
          squared += (ray.to[i] - from[i]) * (ray.to[i] - from[i]);
        }
        const float length = std::sqrt(squared);
        if (length > reach || length < 1) return;
        const float t = 1 - surface / length;  // with noise, the surface may be here
        hit_.set(static_cast<int>(from[0] + t * (ray.to[0] - from[0])),
                 static_cast<int>(from[1] + t * (ray.to[1] - from[1])),
                 static_cast<int>(from[2] + t * (ray.to[2] - from[2])));
        if ((octant.ground & hit) != 0) {  // the last metres of a grazing ray run inside the ground's own cells
          const float sine = std::max(std::fabs(ray.to[2] - from[2]) / length, 1e-3F);
          ray.share = 1 - std::min(kLongestGraze, kGrazing / sine) * cells_per_metre / length;
        }
        if (ray.share > 0) rays.push_back(ray);
      });
    });
  }
}

/// Marks the cells on the way as crossed, up to the first that the scan has hit: Amanatides and Woo.
void FreeSpace::follow(const std::array<float, 3>& from, const Ray& ray) {
  std::array<int, 3> cell, step;
  std::array<float, 3> next, delta;
  for (std::size_t i = 0; i < 3; ++i) {
    const float d = ray.to[i] - from[i];
    cell[i] = static_cast<int>(from[i]);
    step[i] = d < 0 ? -1 : 1;
    delta[i] = d == 0 ? kFar : std::fabs(1 / d);
    next[i] = d == 0 ? kFar : (static_cast<float>(cell[i] + (d < 0 ? 0 : 1)) - from[i]) / d;
  }
  int x = cell[0] - crossed_.x0(), y = cell[1] - crossed_.y0(), z = cell[2] - crossed_.z0();
  const int side = crossed_.side();
  while (x >= 0 && y >= 0 && x < side && y < side && z >= 0 && z < 64) {
    const std::uint64_t bit = std::uint64_t{1} << z;
    if ((hit_.word(x, y) & bit) != 0) return;
    crossed_.word(x, y) |= bit;
    if (next[0] <= next[1] && next[0] <= next[2]) {
      if (next[0] > ray.share) return;
      next[0] += delta[0], x += step[0];
    } else if (next[1] <= next[2]) {
      if (next[1] > ray.share) return;
      next[1] += delta[1], y += step[1];
    } else {
      if (next[2] > ray.share) return;
      next[2] += delta[2], z += step[2];
    }
  }
}

/// What has come to stay: a void cell that is hit again and again, and no ray crosses any more, is void no longer, nor
/// are those around it.
void FreeSpace::revert(const RegionMap& map, const ScanTrace& trace) {
  Tile* last = nullptr;  // cells come in clusters
  for (Region* region : trace.regions) {
    region->forEachHitOctant([&](std::size_t o, Octant& octant) {
      forEachCell(octant.hit, map.cornerOf(*region, o), shift_,
                  [&](const OcTreeKey& corner, std::uint64_t, std::size_t number) {
                    const int x = corner[0] >> shift_, y = corner[1] >> shift_, z = (corner[2] >> shift_) - voids_.z0();
                    const int wx = x - voids_.x0(), wy = y - voids_.y0();
                    if (wx < 1 || wy < 1 || wx + 1 >= voids_.side() || wy + 1 >= voids_.side() || z < 0 || z >= 64)
                      return;
                    if (last == nullptr || last->x != x >> 3 || last->y != y >> 3) last = &tileAt(x >> 3, y >> 3);
                    const CellColumn& column = last->at(x, y);
                    std::uint8_t& in_a_row = octant.hits_in_a_row[number];
                    if (atLeast(column.crossed, 1) >> z & 1) in_a_row = 0;
                    countUp(in_a_row);
                    if (in_a_row < config_.tau_r || ((column.is_void | column.is_open) >> z & 1) == 0) return;
                    const std::uint64_t around = z > 0 ? std::uint64_t{7} << (z - 1) : std::uint64_t{3};
                    for (int cy = y - 1; cy <= y + 1; ++cy)
                      for (int cx = x - 1; cx <= x + 1; ++cx) {
                        CellColumn& beside = tileAt(cx >> 3, cy >> 3).at(cx, cy);
                        beside.is_void &= ~around;
                        beside.is_open &= ~around;
                      }
                  });
    });
  }
}

/// Takes the scan's cells into the tiles' counters, and finds the void.
void FreeSpace::update() {
  const CellGrid clear = crossed_.eroded(), open = crossed_.erodedToOneSide();
  for (int ty = 0; ty < voids_.side(); ty += 8) {
    for (int tx = 0; tx < voids_.side(); tx += 8) {
      const int x = (voids_.x0() + tx) >> 3, y = (voids_.y0() + ty) >> 3;
      Tile* tile = tiles_.find(nameOf(x, y));
      if (tile == nullptr) {
        std::uint64_t any = 0;
        for (int i = 0; i < 64; ++i) any |= crossed_.word(tx + i % 8, ty + i / 8);
        if (any == 0) continue;
        tile = &tileAt(x, y);
      }
      tile->moveTo(voids_.z0());
      for (int i = 0; i < 64; ++i) {
        const int cx = tx + i % 8, cy = ty + i / 8;
        CellColumn& column = tile->columns[static_cast<std::size_t>(i)];
        const std::uint64_t hit = hit_.word(cx, cy);
        for (std::uint64_t& plane : column.crossed) plane &= ~hit;
        count(column.crossed, crossed_.word(cx, cy));
        const std::uint64_t often = atLeast(column.crossed, static_cast<unsigned>(config_.tau_f));
        column.is_void |= clear.word(cx, cy) & often;
        column.is_open |= open.word(cx, cy) & often;
        voids_.word(cx, cy) = column.is_void;
        open_.word(cx, cy) = column.is_open;
      }
    }
  }
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
    delete tile;
  }
}

}  // namespace rhmap
