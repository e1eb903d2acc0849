// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/unknown_space.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace rhmap {
namespace {

std::vector<BoxSample> sampleAxis(const KeySpace& keys, float min, float max, unsigned depth) {
  const auto centreAround = [&](float x) {
    return static_cast<float>(keys.keyToCoord(keys.coordToKey(double(x), depth), depth));
  };
  const auto node_size = static_cast<float>(keys.nodeSize(depth));
  float centre = centreAround(min);
  const float nodes = std::floor((centreAround(max) - centre) / node_size);
  if (!(nodes >= 1.0F)) return {};

  // Both ends are in the tree, which is 65536 cells long; the limit is for a resolution that is no length.
  std::vector<BoxSample> samples(static_cast<std::size_t>(std::min(nodes, 65536.0F)));
  for (BoxSample& sample : samples) {
    centre += node_size;
    sample.centre = centre;
    key_type key;
    if (keys.coordToKeyChecked(double(centre), key)) sample.key = key;
  }
  return samples;
}

}  // namespace

std::array<std::vector<BoxSample>, 3> sampleBox(const KeySpace& keys, const point3d& min, const point3d& max,
                                                unsigned depth) {
  if (depth == 0 || depth > kTreeDepth) depth = kTreeDepth;
  return {sampleAxis(keys, min.x(), max.x(), depth), sampleAxis(keys, min.y(), max.y(), depth),
          sampleAxis(keys, min.z(), max.z(), depth)};
}

void checkNumberOf(const std::array<std::vector<BoxSample>, 3>& samples) {
  std::uint64_t number = 1;  // below 2^48
  for (const auto& axis : samples) number *= axis.size();
  if (number > kMaxBoxSamples)
    throw std::length_error("a box of " + std::to_string(number) + " nodes is too large to list what is unknown in it");
}

}  // namespace rhmap
