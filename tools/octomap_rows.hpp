// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "rhmap/core/key_set.hpp"
#include "rhmap/eval/estimate.hpp"
#include "rhmap/eval/labelled_scan.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap::tools {

/// What OctoMap leaves of a sequence, which is a way to remove what moves as well: rays erase what they cross.
struct OctomapBaseline {
  std::unique_ptr<OcTree> map;  ///< by insertPointCloud: cell for cell OctoMap's
  KeySet ground;                ///< cells that the removal's ground estimate took for ground when they were hit
};

/// Runs it over the window of a sequence, with a bar of progress.
OctomapBaseline runOctomapBaseline(const io::ScanSequence& sequence, const eval::SequenceWindow& window,
                                   double resolution);

/// The rows `octomap` and `octomap, ground kept`: rays that graze the ground erase it, so methods are also compared
/// with an OctoMap whose ground they cannot touch. Map and ground must live as long as the rows.
std::vector<eval::Estimate> octomapRows(const OcTree& map, const KeySet& ground);

}  // namespace rhmap::tools
