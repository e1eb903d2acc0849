// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_utils.h>

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <istream>
#include <ostream>

#include "rhmap/core/block_store.hpp"

namespace rhmap {

/// OctoMap's `children`, the name that node classes of users work with. There is no such pointer in our nodes: this is
/// an empty member which finds the children from where it is. Making and deleting children is the tree's business, so
/// giving up the array, as OctoMap's own trees do when they prune, has nothing to do here.
class ChildArray {
 public:
  /// Null where there is no child.
  AbstractOcTreeNode* operator[](unsigned i) const { return childrenOf(this)[i]; }
  explicit operator bool() const { return !childrenOf(this).empty(); }
  friend bool operator==(const ChildArray& c, std::nullptr_t) { return !c; }

  ChildArray& operator=(std::nullptr_t) { return *this; }  // children = NULL
  struct NoArray {};
  operator NoArray*() const { return nullptr; }  // NOLINT: delete[] children
};

/// A node that carries one value.
template <class T>
class OcTreeDataNode : public AbstractOcTreeNode {
 public:
  using DataType = T;

  OcTreeDataNode() = default;
  OcTreeDataNode(T initial) : value(initial) {}  // NOLINT: implicit, as OctoMap's is

  bool operator==(const OcTreeDataNode& other) const { return value == other.value; }

  T getValue() const { return value; }
  void setValue(T v) { value = v; }

  void copyData(const OcTreeDataNode& from) { value = from.value; }

  /// The tree's nodeChildExists() and nodeHasChildren() are quicker. A node that is in no tree has no children.
  bool childExists(unsigned i) const { return children[i] != nullptr; }
  bool hasChildren() const { return static_cast<bool>(children); }

  /// What .ot files hold of a node: the value's bytes in the machine's order. A node class with more data redefines
  /// either these three, or just readData and writeData, which is slower.
  static constexpr std::size_t kDataBytes = sizeof(T);
  void toBytes(char* to) const { std::memcpy(to, &value, sizeof value); }
  void fromBytes(const char* from) { std::memcpy(&value, from, sizeof value); }

  std::istream& readData(std::istream& s) { return s.read(reinterpret_cast<char*>(&value), sizeof value); }
  std::ostream& writeData(std::ostream& s) const {
    return s.write(reinterpret_cast<const char*>(&value), sizeof value);
  }

 protected:
  [[no_unique_address]] ChildArray children;
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

  /// Log-odds of the mean probability of the children; -infinity without children.
  double getMeanChildLogOdds() const;
  /// Largest log-odds of the children, -FLT_MAX without children.
  float getMaxChildLogOdds() const;
  /// OctoMap's rule for inner nodes: the largest value of the children.
  void updateOccupancyChildren() { setLogOdds(getMaxChildLogOdds()); }

  /// The same where the children are at hand. Trees use it for all node classes that leave updateOccupancyChildren()
  /// alone: a class that has its own hides this one.
  template <class NODE>
  void updateOccupancyChildren(const Octet<NODE>& octet) {
    setLogOdds(maxLogOdds(octet));
  }

  /// Largest value of the children, -FLT_MAX if there is none; of equal values (0 and -0) the first, NaN never.
  template <class NODE>
  static float maxLogOdds(const Octet<NODE>& octet) {
    // The order of the comparison, and of what is compared with what, settles ties and NaN as OctoMap's loop does.
    const auto larger = [](float first, float second) { return second > first ? second : first; };
    const auto value = [&](unsigned i) { return larger(-FLT_MAX, octet.nodes[i].getLogOdds()); };
    if (octet.mask == 0xff)
      return larger(larger(larger(value(0), value(1)), larger(value(2), value(3))),
                    larger(larger(value(4), value(5)), larger(value(6), value(7))));
    float max = -FLT_MAX;
    for (unsigned rest = octet.mask; rest != 0; rest &= rest - 1)
      max = larger(max, value(static_cast<unsigned>(std::countr_zero(rest))));
    return max;
  }
};
static_assert(sizeof(OcTreeNode) == sizeof(float));

inline float OcTreeNode::getMaxChildLogOdds() const {
  const NodeChildren all = childrenOf(this);
  float max = -FLT_MAX;
  for (unsigned i = 0; i < 8; ++i)
    if (all.has(i)) {
      const float log_odds = static_cast<const OcTreeNode*>(all[i])->getLogOdds();
      if (log_odds > max) max = log_odds;
    }
  return max;
}

inline double OcTreeNode::getMeanChildLogOdds() const {
  const NodeChildren all = childrenOf(this);
  double sum = 0;
  int count = 0;
  for (unsigned i = 0; i < 8; ++i)
    if (all.has(i)) {
      sum += static_cast<const OcTreeNode*>(all[i])->getOccupancy();
      ++count;
    }
  const double mean = count > 0 ? sum / count : 0;
  return std::log(mean / (1 - mean));
}

}  // namespace rhmap
