// SPDX-License-Identifier: BSD-3-Clause
#include "scan_insertion.hpp"

#include <algorithm>
#include <cmath>

namespace rhmap {
namespace {

/// The columns around the sensor, by position.
class ColumnGrid {
 public:
  ColumnGrid(const RegionMap& map, const OcTreeKey& sensor, double reach, double resolution)
      : half_(static_cast<int>(std::ceil(reach / (map.size() * resolution))) + 1),
        side_(2 * half_ + 1),
        x0_((sensor[0] >> map.bits()) - half_),
        y0_((sensor[1] >> map.bits()) - half_),
        index_(static_cast<std::size_t>(side_ * side_), -1) {}

  /// The number of a column in the trace, below 0 if it has none yet; null outside of the grid.
  std::int32_t* at(int x, int y) {
    x -= x0_, y -= y0_;
    if (x < 0 || y < 0 || x >= side_ || y >= side_) return nullptr;
    return &index_[static_cast<std::size_t>(y * side_ + x)];
  }

 private:
  int half_, side_, x0_, y0_;
  std::vector<std::int32_t> index_;
};

}  // namespace

ScanTrace insertScan(RegionMap& map, const ScanPoints& points, const OcTreeKey& sensor, double reach, double resolution,
                     std::uint32_t scan, bool insert, int firm) {
  ScanTrace trace{.scan = scan};
  ColumnGrid grid(map, sensor, reach, resolution);
  const auto farthest = static_cast<float>(reach);
  const int bits = map.bits();

  Column* column = nullptr;
  Region* region = nullptr;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const OcTreeKey& cube = points.cube[k];
    const auto x = static_cast<key_type>(cube[0] >> bits), y = static_cast<key_type>(cube[1] >> bits),
               z = static_cast<key_type>(cube[2] >> bits);
    if (column == nullptr || column->x != x || column->y != y) {
      column = &map.getOrCreate(x, y);
      region = nullptr;
    }
    if (region == nullptr || region->z != z) {
      region = &map.getOrCreate(*column, z);
      if (region->scan != scan) {
        region->scan = scan;
        for (int o = 0; o < map.octants(); ++o) region->octants[static_cast<std::size_t>(o)].hit = region->octants[static_cast<std::size_t>(o)].fresh = region->octants[static_cast<std::size_t>(o)].appeared = 0;
        trace.regions.push_back(region);
      }
    }
    if (points.range[k] <= farthest) {
      std::int32_t* index = grid.at(x, y);
      if (index != nullptr) {
        if (*index < 0) {
          *index = static_cast<std::int32_t>(trace.columns.size());
          trace.columns.push_back({.column = column});
        }
        ScanColumn& context = trace.columns[static_cast<std::size_t>(*index)];
        context.z_min = std::min(context.z_min, int{cube[2]});
        context.z_max = std::max(context.z_max, int{cube[2]});
        ++context.points;
      }
    }
    Octant& octant = region->octants[static_cast<std::size_t>(map.octantOf(cube))];
    const int bit = bitOf(cube);
    const std::uint64_t mask = std::uint64_t{1} << bit;
    if ((octant.hit & mask) != 0) continue;
    octant.hit |= mask;
    if (!insert) continue;
    octant.doubted &= ~mask;
    if ((octant.occupied & mask) == 0) {
      octant.occupied |= mask;
      octant.fresh |= mask;
      if (column->h_max < column->h_min) {
        column->h_min = column->h_max = cube[2];
      } else {
        column->h_min = std::min(column->h_min, int{cube[2]});
        column->h_max = std::max(column->h_max, int{cube[2]});
      }
    }
    std::uint8_t& hits = octant.hits[static_cast<std::size_t>(bit)];
    hits = static_cast<std::uint8_t>(hits + (hits < 255));
    octant.missed[static_cast<std::size_t>(bit)] = 0;
    if (hits >= firm) octant.firm |= mask;
  }
  return trace;
}

}  // namespace rhmap
