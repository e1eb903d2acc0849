// SPDX-License-Identifier: BSD-3-Clause
#include "scan_context.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace rhmap {
namespace {

constexpr int kMaxRingRows = 2;  // a beam's elevation wavers by a row

ScanColumn* columnAt(ScanTrace& trace, ColumnGrid& grid, int x, int y) {
  const std::int32_t* index = grid.at(x, y);
  return index == nullptr || *index < 0 ? nullptr : &trace.columns[static_cast<std::size_t>(*index)];
}

/// The first pixel of the column, going `step` rows at a time, that is nearer by more than `r`: the number of its
/// point.
std::optional<std::size_t> firstNearer(const RangeImage& image, int row, int column, int step, float r) {
  const float range = image.at(row, column);
  for (int i = row + step; i >= 0 && i < image.projection().rows; i += step) {
    if (range - image.at(i, column) > r) return static_cast<std::size_t>(image.pointAt(i, column));
  }
  return std::nullopt;
}

}  // namespace

double ratio1(const Context2d& scan, int map_min, int map_max, bool max_ring) {
  const int top = max_ring && scan.max_ring ? scan.z_max : map_max;
  return double(scan.z_max - scan.z_min + 1) / double(top - map_min + 1);
}

double ratio2(const Context3d& scan, int map_min, int map_max) {
  return double(scan.z_max - scan.z_min + 1) / double(map_max - map_min + 1);
}

void findMaxRing(const RangeImage& image, const ScanPoints& points, const RegionMap& map, ColumnGrid& grid,
                 ScanTrace& trace) {
  for (int j = 0; j < image.projection().columns; ++j) {
    for (int i = 0; i < std::min(kMaxRingRows, image.projection().rows); ++i) {
      const std::int32_t k = image.pointAt(i, j);
      if (k < 0) continue;
      const OcTreeKey cube = points.cubeAt(static_cast<std::size_t>(k));
      if (ScanColumn* column = columnAt(trace, grid, cube[0] >> map.bits(), cube[1] >> map.bits()))
        column->max_ring = true;
      break;
    }
  }
}

std::vector<Context3d> findBulgeDented(const RangeImage& image, const ScanPoints& points, const ContextConfig& config,
                                       const RegionMap& map, ColumnGrid& grid, ScanTrace& trace) {
  std::map<std::tuple<key_type, key_type, key_type>, Context3d> contexts;
  const int bits = map.bits();
  for (int i = 0; i < image.projection().rows; ++i) {
    for (int j = 0; j < image.projection().columns; ++j) {
      const std::int32_t k = image.pointAt(i, j);
      if (k < 0 || image.at(i, j) > static_cast<float>(config.max_range)) continue;
      const auto share = static_cast<float>(config.r_share) * image.at(i, j);
      const auto above = firstNearer(image, i, j, -1, std::max(static_cast<float>(config.r_1), share));
      const auto below = firstNearer(image, i, j, 1, std::max(static_cast<float>(config.r_2), share));
      if (!above && !below) continue;
      const OcTreeKey cube = points.cubeAt(static_cast<std::size_t>(k));
      const auto x = static_cast<key_type>(cube[0] >> bits), y = static_cast<key_type>(cube[1] >> bits),
                 z = static_cast<key_type>(cube[2] >> bits);
      if (ScanColumn* column = columnAt(trace, grid, x, y)) column->bulge_dented = true;
      const int height = cube[2];
      Context3d& context =
          contexts.try_emplace({x, y, z}, Context3d{x, y, z, height, height, 1 << 16, -1}).first->second;
      context.z_min = std::min(context.z_min, height);
      context.z_max = std::max(context.z_max, height);
      if (above) context.sup = std::min(context.sup, int{points.cubeAt(*above)[2]});
      if (below) context.inf = std::max(context.inf, int{points.cubeAt(*below)[2]});
    }
  }
  std::vector<Context3d> result;
  for (auto& [at, context] : contexts) {
    if (context.sup == 1 << 16) context.sup = context.z_max;
    if (context.inf == -1) context.inf = context.z_min;
    result.push_back(context);
  }
  return result;
}

std::vector<Context2d> contextsOf(const ScanTrace& trace) {
  std::vector<Context2d> contexts;
  contexts.reserve(trace.columns.size());
  for (const ScanColumn& c : trace.columns)
    contexts.push_back({c.column->x, c.column->y, c.z_min, c.z_max, c.points, c.max_ring, c.bulge_dented});
  return contexts;
}

}  // namespace rhmap
