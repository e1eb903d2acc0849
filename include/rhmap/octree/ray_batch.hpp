// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rhmap/octree/ray.hpp"
#include "rhmap/octree/scan_masks.hpp"

namespace rhmap {

/// Rays ready to walk, one array a property, so that several are worked on side by side in the lanes of vectors.
///
/// Along each axis that a ray goes down, the bits of its cells are inverted (`mirror` has these axes' bits): in this
/// mirror every step of every ray goes up.
class RayBatch {
 public:
  static constexpr std::size_t kCapacity = 1024;
  static constexpr std::size_t kPad = 8;  ///< at both ends of a column, to load and store around a ray

  std::size_t size() const { return size_; }
  std::size_t room() const { return kCapacity - size_; }
  void clear() { size_ = 0; }

  void add(const RaySegment& ray) {
    const std::size_t at = kPad + size_;
    mirror[at] = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      t_max[axis][at] = ray.t_max[axis];
      t_delta[axis][at] = ray.t_delta[axis];
      if (ray.step[axis] < 0) mirror[at] |= cell_word::kAxis[axis];
    }
    length[at] = ray.length;
    cell[at] = cell_word::fromKey(ray.key) ^ mirror[at];
    end[at] = cell_word::fromKey(ray.end) ^ mirror[at];
    ++size_;
  }

  /// For rays that were written into the columns.
  void grow(std::size_t rays) { size_ += rays; }

  template <class T>
  using Column = std::array<T, kPad + kCapacity + kPad>;  // ray i stands at kPad + i
  std::array<Column<double>, 3> t_max;
  std::array<Column<double>, 3> t_delta;
  Column<double> length;
  Column<std::uint64_t> mirror;
  Column<std::uint64_t> cell;
  Column<std::uint64_t> end;

 private:
  std::size_t size_ = 0;
};

}  // namespace rhmap
