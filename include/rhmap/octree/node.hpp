// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_utils.h>

#include <bit>
#include <cfloat>
#include <cstddef>
#include <cstring>
#include <istream>
#include <ostream>

#include "rhmap/core/block_store.hpp"

namespace rhmap {

/// A node that carries one value. Children are not its business: ask the tree (`getNodeChild`, `nodeHasChildren`).
template <class T>
class OcTreeDataNode {
 public:
  using DataType = T;

  OcTreeDataNode() = default;
  explicit OcTreeDataNode(T initial) : value(initial) {}

  bool operator==(const OcTreeDataNode& other) const { return value == other.value; }

  T getValue() const { return value; }
  void setValue(T v) { value = v; }

  void copyData(const OcTreeDataNode& from) { value = from.value; }

  /// What .ot files hold of a node: the value's bytes in the machine's order.
  static constexpr std::size_t kDataBytes = sizeof(T);
  void toBytes(char* to) const { std::memcpy(to, &value, sizeof value); }
  void fromBytes(const char* from) { std::memcpy(&value, from, sizeof value); }

  std::istream& readData(std::istream& s) { return s.read(reinterpret_cast<char*>(&value), sizeof value); }
  std::ostream& writeData(std::ostream& s) const {
    return s.write(reinterpret_cast<const char*>(&value), sizeof value);
  }

 protected:
  T value{};
};

/// Occupancy of a cube as log-odds: ln(p / (1 - p)); 0 where nothing was seen yet.
class OcTreeNode : public OcTreeDataNode<float> {
 public:
  OcTreeNode() = default;

  /// Probability of being occupied.
  double getOccupancy() const { return octomap::probability(value); }
  float getLogOdds() const { return value; }
  /// Without clamping.
  void setLogOdds(float log_odds) { value = log_odds; }
  /// Without clamping.
  void addValue(const float& update) { value += update; }

  /// OctoMap's rule for inner nodes: the largest value of the children.
  template <class NODE>
  void updateOccupancyChildren(const Octet<NODE>& children) {
    setLogOdds(maxLogOdds(children));
  }

  /// Largest value of the children, -FLT_MAX if there is none; of equal values (0 and -0) the first, NaN never.
  template <class NODE>
  static float maxLogOdds(const Octet<NODE>& children) {
    // The order of the comparison, and of what is compared with what, settles ties and NaN as OctoMap's loop does.
    const auto larger = [](float first, float second) { return second > first ? second : first; };
    const auto value = [&](unsigned i) { return larger(-FLT_MAX, children.nodes[i].getLogOdds()); };
    if (children.mask == 0xff)
      return larger(larger(larger(value(0), value(1)), larger(value(2), value(3))),
                    larger(larger(value(4), value(5)), larger(value(6), value(7))));
    float max = -FLT_MAX;
    for (unsigned rest = children.mask; rest != 0; rest &= rest - 1)
      max = larger(max, value(static_cast<unsigned>(std::countr_zero(rest))));
    return max;
  }
};
static_assert(sizeof(OcTreeNode) == sizeof(float));

}  // namespace rhmap
