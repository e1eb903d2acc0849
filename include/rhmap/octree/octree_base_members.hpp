// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Members of OcTreeBaseImpl that are more than a line or two; included by octree_base.hpp.

#include <algorithm>

#include "rhmap/core/leaf_extremes.hpp"
#include "rhmap/octree/map_codec.hpp"
#include "rhmap/octree/octree_base.hpp"

namespace rhmap {

/// `upper`: the upper end [m] of a leaf along an axis from its centre and its size.
template <class NODE, class INTERFACE>
template <class Upper>
auto OcTreeBaseImpl<NODE, INTERFACE>::computeBounds(Upper&& upper) const -> Bounds {
  Bounds bounds{.version = store_->version()};
  if (store_->empty()) return bounds;
  bounds.min.fill(std::numeric_limits<double>::max());
  bounds.max.fill(-std::numeric_limits<double>::max());
  const LeafExtremes extremes(*store_);
  for (unsigned depth = 0; depth <= kTreeDepth; ++depth) {
    if (!extremes.hasLeaves(depth)) continue;
    const double size = getNodeSize(depth);
    const OcTreeKey first = centreKey(extremes.min(depth), depth);
    const OcTreeKey last = centreKey(extremes.max(depth), depth);
    for (unsigned i = 0; i < 3; ++i) {
      bounds.min[i] = std::min(bounds.min[i], keyToCoord(first[i], depth) - size / 2.0);
      bounds.max[i] = std::max(bounds.max[i], upper(keyToCoord(last[i], depth), size));
    }
  }
  return bounds;
}

template <class NODE, class INTERFACE>
std::ostream& OcTreeBaseImpl<NODE, INTERFACE>::writeData(std::ostream& s) const {
  codec::ByteWriter out(s);
  if (const NodeRef root = store_->root()) codec::writeValues(*store_, root, out);
  return s;
}

template <class NODE, class INTERFACE>
std::istream& OcTreeBaseImpl<NODE, INTERFACE>::readData(std::istream& s) {
  if (!s.good() || !store_->empty()) {
    s.setstate(std::ios::failbit);
    return s;
  }
  try {
    codec::ByteReader in(s);
    codec::readValues(*store_, store_->createRoot(), in);
  } catch (const std::runtime_error&) {
    store_->clear();
    s.setstate(std::ios::failbit);
  }
  return s;
}

}  // namespace rhmap
