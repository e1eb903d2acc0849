// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>

#include "octant.hpp"
#include "rhmap/core/record_pool.hpp"

namespace rhmap {

/// Memory for octants at addresses that stay. Masks lie side by side, so that neighbours share pages; the histories lie
/// apart, and the address of the masks tells where.
class OctantPool {
 public:
  explicit OctantPool(PiecePool& pieces) : pool_(pieces, {.bytes = sizeof(Octant), .apart = sizeof(OctantHistory)}) {}

  /// Of nothing that is known yet.
  Octant* allocate() {
    auto* octant = new (pool_.allocate()) Octant();
    new (apartOf(octant)) OctantHistory();
    return octant;
  }
  void release(Octant* octant) noexcept { pool_.release(octant); }

  /// The history of an octant that was allocated. Inlined by force, as what it calls.
  [[gnu::always_inline]] static OctantHistory* historyAt(const Octant* octant) {
    return static_cast<OctantHistory*>(apartOf(octant));
  }

  std::size_t memoryUsage() const { return pool_.memoryUsage(); }

 private:
  static_assert(std::is_trivially_destructible_v<Octant> && std::is_trivially_destructible_v<OctantHistory>);

  [[gnu::always_inline]] static void* apartOf(const Octant* octant) {
    return RecordPool::apartOf(octant, sizeof(Octant), sizeof(OctantHistory));
  }

  RecordPool pool_;
};

/// Of an octant of a RegionMap.
[[gnu::always_inline]] inline OctantHistory& historyOf(Octant& octant) { return *OctantPool::historyAt(&octant); }
[[gnu::always_inline]] inline const OctantHistory& historyOf(const Octant& octant) {
  return *OctantPool::historyAt(&octant);
}

}  // namespace rhmap
