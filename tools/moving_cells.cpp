// SPDX-License-Identifier: BSD-3-Clause
#include "moving_cells.hpp"

#include <algorithm>
#include <unordered_map>

#include "rhmap/octree/key_space.hpp"

namespace rhmap::tools {

KeySet movingCells(const io::ScanSequence& sequence, const eval::SequenceWindow& window, double resolution,
                   const std::function<void()>& progress) {
  const eval::Labels labels;
  const KeySpace keys(resolution);
  std::unordered_map<OcTreeKey, int, OcTreeKey::KeyHash> lead;  // of the moving points over the static ones
  for (std::size_t i = window.first; i <= window.last.value_or(sequence.size() - 1); ++i) {
    const eval::LabelledScan scan = eval::readLabelledScan(sequence, i, window);
    for (std::size_t k = 0; k < scan.points.size(); ++k) {
      const eval::Kind kind = labels.kind(scan.labels[k]);
      OcTreeKey key;
      if (kind == eval::Kind::kIgnored || !keys.coordToKeyChecked(scan.points[k], key)) continue;
      lead[key] += kind == eval::Kind::kDynamic ? 1 : -1;
    }
    progress();
  }
  KeySet moving;
  for (const auto& [key, votes] : lead)
    if (votes > 0) moving.insert(key);
  return moving;
}

bool holdsOneOf(const KeySet& cells, const OcTreeKey& corner, unsigned depth) {
  const unsigned edge = 1U << (kTreeDepth - depth);
  const auto within = [&](const OcTreeKey& key) {
    return unsigned(key[0] - corner[0]) < edge && unsigned(key[1] - corner[1]) < edge &&
           unsigned(key[2] - corner[2]) < edge;
  };
  // A leaf may be larger than all of what moved.
  if (depth < kTreeDepth - 4) return std::any_of(cells.begin(), cells.end(), within);
  for (unsigned i = 0; i < edge * edge * edge; ++i) {
    const OcTreeKey key(static_cast<key_type>(corner[0] + i % edge), static_cast<key_type>(corner[1] + i / edge % edge),
                        static_cast<key_type>(corner[2] + i / edge / edge));
    if (cells.contains(key)) return true;
  }
  return false;
}

}  // namespace rhmap::tools
