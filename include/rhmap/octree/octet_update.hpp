// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "rhmap/octree/node.hpp"
#include "rhmap/octree/sensor_model.hpp"
#include "rhmap/octree/structure.hpp"

namespace rhmap {

/// What a scan does to eight cells.
template <class NODE>
struct OctetUpdate {
  NODE* cells;
  NODE* parent;            ///< the node above them, which is to follow; null if it is not
  float start;             ///< value of the cells that were not there
  std::uint8_t octet;      ///< number in the region
  std::uint8_t hit, free;  ///< the cells that are marked; none in both
  std::uint8_t existing;   ///< the cells that were there before; what OctoMap's early abort is asked about
  std::uint8_t after;      ///< the cells that are there afterwards, marked ones included

  // The outcome.
  std::uint8_t changed;  ///< the cells that have a new value
  bool uniform;          ///< all eight are there and equal
};

/// Updates the marked cells and, where any has changed, what they have made of their parent: a copy of them if they are
/// uniform, and else recomputed. The nodes in `after` have been made, with the value `start` if they are new.
template <class NODE>
void updateOctets(std::span<OctetUpdate<NODE>> octets, const SensorModel& model) {
  for (OctetUpdate<NODE>& o : octets) {
    o.changed = 0;
    for (unsigned rest = unsigned{o.hit} | o.free; rest != 0; rest &= rest - 1) {
      const int i = std::countr_zero(rest);
      const float update = o.hit >> i & 1 ? model.hit : model.miss;
      const float value = o.cells[i].getLogOdds();
      if ((o.existing >> i & 1) != 0 && model.settled(value, update)) continue;
      o.cells[i].setLogOdds(model.updated(value, update));
      o.changed = static_cast<std::uint8_t>(o.changed | 1U << i);
    }
    o.uniform = o.after == 0xff;
    for (int i = 1; i < 8 && o.uniform; ++i) o.uniform = o.cells[i] == o.cells[0];
    if (o.changed == 0 || o.parent == nullptr) continue;
    if (o.uniform) {
      o.parent->copyData(o.cells[0]);
    } else {
      structure::recompute(*o.parent, Octet<NODE>{o.cells, o.after});
    }
  }
}

/// The same in vectors; the widest that the machine has, and the same bits with any. Here the memory of new nodes may
/// hold anything.
void updateOctets(std::span<OctetUpdate<OcTreeNode>> octets, const SensorModel& model);

}  // namespace rhmap
