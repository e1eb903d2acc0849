// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "rhmap/core/block.hpp"

namespace rhmap {

/// The way from one region up to the root: the nodes at the depths 13 ... 0, each with the octet of its children. A
/// store remembers one, because updates of single cells come in clusters: nothing above an existing region can go away
/// or move, so that it serves until the region itself is removed.
template <class NODE>
struct Trunk {
  struct Step {
    Block* block;  ///< of the node
    NODE* node;
    const NODE* children;
    const std::uint8_t* mask;

    /// The value that the children gave last and what they were then. Whoever asks again gets it from here as long as
    /// they are the same, bit by bit: a node may have been changed through its address, which nobody tells us.
    std::array<std::uint64_t, sizeof(NODE)> seen{};
    std::uint64_t seen_mask = 0;
    std::uint32_t value = 0;

    bool isAsSeen() const {
      std::array<std::uint64_t, sizeof(NODE)> now;
      std::memcpy(now.data(), static_cast<const void*>(children), sizeof now);
      std::uint64_t differs = *mask ^ seen_mask;
      for (std::size_t i = 0; i < now.size(); ++i) differs |= now[i] ^ seen[i];
      return differs == 0;
    }
    void see(float result) {
      std::memcpy(seen.data(), static_cast<const void*>(children), sizeof seen);
      seen_mask = *mask;
      value = std::bit_cast<std::uint32_t>(result);
    }
  };

  static constexpr std::size_t kSteps = kTreeDepth - 2;

  /// `region` contains this key.
  bool leadsTo(const OcTreeKey& key) const {
    if (region == nullptr) return false;
    const auto differs = [&](unsigned i) { return unsigned{region->corner()[i]} ^ key[i]; };
    return (differs(0) | differs(1) | differs(2)) < 8;
  }

  Block* region = nullptr;
  std::array<Step, kSteps> steps;  ///< upwards
};

}  // namespace rhmap
