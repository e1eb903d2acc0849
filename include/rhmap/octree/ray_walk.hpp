// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rhmap/octree/ray.hpp"
#include "rhmap/octree/scan_masks.hpp"

namespace rhmap {

/// Rays ready to walk, one array a property, so that several are walked side by side in the lanes of vectors.
class RayBatch {
 public:
  static constexpr std::size_t kCapacity = 1024;

  bool full() const { return size_ == kCapacity; }
  std::size_t size() const { return size_; }
  void clear() { size_ = 0; }

  void add(const RaySegment& ray) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      t_max[axis][size_] = ray.t_max[axis];
      t_delta[axis][size_] = ray.t_delta[axis];
      step[axis][size_] = cell_word::stepAlong(static_cast<int>(axis), ray.step[axis]);
    }
    length[size_] = ray.length;
    cell[size_] = cell_word::fromKey(ray.key);
    end[size_] = cell_word::fromKey(ray.end);
    ++size_;
  }

  template <class T>
  using Column = std::array<T, kCapacity>;
  alignas(64) std::array<Column<double>, 3> t_max;
  alignas(64) std::array<Column<double>, 3> t_delta;
  alignas(64) std::array<Column<std::uint64_t>, 3> step;  ///< see cell_word::stepAlong
  alignas(64) Column<double> length;
  alignas(64) Column<std::uint64_t> cell;
  alignas(64) Column<std::uint64_t> end;

 private:
  std::size_t size_ = 0;
};

/// Marks the cells that the rays cross: what forEachRayKey visits, for every ray of the batch. Uses the widest vectors
/// that the machine has; the result is the same bits with any.
void walkRays(const RayBatch& rays, ScanMasks& masks);

}  // namespace rhmap
