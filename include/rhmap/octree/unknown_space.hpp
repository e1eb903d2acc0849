// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "rhmap/core/region_cursor.hpp"
#include "rhmap/octree/key_space.hpp"

namespace rhmap {

/// Where a box is sampled along one axis.
struct BoxSample {
  float centre;                 ///< [m]
  std::optional<key_type> key;  ///< of the cell there; empty outside of the tree
};

/// The box between two points as getUnknownLeafCenters samples it: along each axis, one sample a node of `depth`.
///
/// That is OctoMap's arithmetic. The first node along each axis is left out and the last one is in, and each centre is
/// the one before it plus the node's size, in float, so that far out they wander off the true centres (and, with
/// `key` following them, may even meet a node twice). Corners are turned into keys without a range check: what is
/// outside of the tree wraps around, NaN and everything beyond 2^31 cells stand for the middle of the tree. Along an
/// axis where the box is not at least one node long, or is inside out, there are no samples.
///
/// `depth`: 0 and all above 16 mean 16.
std::array<std::vector<BoxSample>, 3> sampleBox(const KeySpace& keys, const point3d& min, const point3d& max,
                                                unsigned depth);

/// The samples of a box, all axes together, may not be more than this; see forEachUnknown.
inline constexpr std::uint64_t kMaxBoxSamples = std::uint64_t{1} << 33;

/// Throws std::length_error for more samples than kMaxBoxSamples.
void checkNumberOf(const std::array<std::vector<BoxSample>, 3>& samples);

/// Calls `visit(point3d)` with the centre [m] of each sample of the box at which nothing is known: there is no node at
/// `depth` nor a leaf that contains it. Outside of the tree nothing is known. z runs fastest, x slowest.
///
/// Throws std::length_error, before the first visit, for a box of more than 2^33 nodes (205 m a side with cells of
/// 0.1 m), which would take OctoMap a quarter of an hour and 275 GB.
template <class NODE, class Visit>
void forEachUnknown(const BlockStore<NODE>& store, const KeySpace& keys, const point3d& min, const point3d& max,
                    unsigned depth, Visit&& visit) {
  const auto samples = sampleBox(keys, min, max, depth);
  checkNumberOf(samples);
  const bool cells = depth == 0 || depth >= kTreeDepth;
  RegionCursor<NODE> cursor(store);  // neighbours along z share a region
  for (const BoxSample& x : samples[0])
    for (const BoxSample& y : samples[1]) {
      const bool inside = x.key && y.key;
      for (const BoxSample& z : samples[2]) {
        if (inside && z.key) {
          const OcTreeKey key(*x.key, *y.key, *z.key);
          if (cells ? cursor.search(key) != nullptr : bool(store.search(key, depth))) continue;
        }
        visit(point3d(x.centre, y.centre, z.centre));
      }
    }
}

}  // namespace rhmap
