// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <octomap/OcTreeKey.h>
#include <octomap/octomap_types.h>

#include <string>

namespace rhmap::test {

/// octomap::CountingOcTree, whose header is C++ up to 17 only.
class OctomapCounting {
 public:
  explicit OctomapCounting(double resolution);
  ~OctomapCounting();
  unsigned update(const octomap::OcTreeKey& key);
  void prune();
  std::string bytes() const;
  octomap::point3d_list centers(unsigned min_hits) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace rhmap::test
