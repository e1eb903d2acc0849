// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Members of OcTreeBaseImpl that are more than a line or two; included by octree_base.hpp.

#include <algorithm>

#include "rhmap/octree/map_codec.hpp"
#include "rhmap/octree/octree_base.hpp"

namespace rhmap {

template <class NODE, class INTERFACE>
auto OcTreeBaseImpl<NODE, INTERFACE>::computeBounds() const -> Bounds {
  Bounds bounds;
  if (store_->empty()) return bounds;
  bounds.min.fill(std::numeric_limits<double>::max());
  bounds.max.fill(-std::numeric_limits<double>::max());
  for (auto it = begin(), last = end(); it != last; ++it) {
    const double size = it.getSize();
    const std::array<double, 3> centre{it.getX(), it.getY(), it.getZ()};
    for (std::size_t i = 0; i < 3; ++i) {
      const double low = centre[i] - size / 2.0;
      bounds.min[i] = std::min(bounds.min[i], low);
      bounds.max[i] = std::max(bounds.max[i], low + size);
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
  bounds_.reset();
  try {
    codec::readValues(*store_, store_->createRoot(), s);
  } catch (const std::runtime_error&) {
    store_->clear();
    s.setstate(std::ios::failbit);
  }
  return s;
}

}  // namespace rhmap
