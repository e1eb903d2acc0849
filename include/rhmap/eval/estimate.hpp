// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "rhmap/eval/labelled_scan.hpp"
#include "rhmap/eval/labels.hpp"

namespace rhmap::eval {

/// One byte a point of a scan: whether the map still has it.
using KeptMask = std::vector<std::uint8_t>;

/// A row of the table: what somebody left of the sequence, as an answer for each of its points or as a cloud.
struct Estimate {
  std::string name;
  std::function<KeptMask(const LabelledScan&)> keep;  ///< one answer a point; empty: the estimate is `cloud`
  std::vector<octomap::point3d> cloud;                ///< made elsewhere; world frame [m], no labels
};

/// A row from `bool kept(const octomap::point3d&)`, asked for the sequence's points in the world frame [m], several
/// times; e.g. whether the cleaned map is occupied there.
template <class Kept>
Estimate keptBy(std::string name, Kept kept) {
  return {.name = std::move(name),
          .keep =
              [kept = std::move(kept)](const LabelledScan& scan) {
                KeptMask mask(scan.points.size());
                for (std::size_t k = 0; k < mask.size(); ++k) mask[k] = kept(scan.points[k]) ? 1 : 0;
                return mask;
              },
          .cloud = {}};
}

/// A row from an octree: a point is kept where the tree is occupied. The tree must live as long as the estimate.
template <class Tree>
Estimate keptInMap(std::string name, const Tree& tree) {
  return keptBy(std::move(name), [&tree](const octomap::point3d& point) {
    const auto* node = tree.search(point);
    return node != nullptr && tree.isNodeOccupied(node);
  });
}

/// A row from points [m] in the world frame.
Estimate keptInCloud(std::string name, std::vector<octomap::point3d> cloud);

/// The row `no removal`: everything is kept.
Estimate noRemoval();

/// The row `oracle`: exactly the points with a dynamic label are left out. What it loses, the protocol's cells cost.
Estimate oracle(const Labels& labels);

}  // namespace rhmap::eval
