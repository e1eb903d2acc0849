// SPDX-License-Identifier: BSD-3-Clause
#include "octomap_counting.hpp"

#include <octomap/CountingOcTree.h>

#include <sstream>

namespace rhmap {
namespace test {

struct OctomapCounting::Tree : octomap::CountingOcTree {
  using CountingOcTree::CountingOcTree;
};

OctomapCounting::OctomapCounting(double resolution) : tree_(new Tree(resolution)) {}
OctomapCounting::~OctomapCounting() = default;

unsigned OctomapCounting::update(const octomap::OcTreeKey& key) { return tree_->updateNode(key)->getCount(); }
void OctomapCounting::prune() { tree_->prune(); }

std::string OctomapCounting::bytes() const {
  std::ostringstream s;
  tree_->write(s);
  return s.str();
}

octomap::point3d_list OctomapCounting::centers(unsigned min_hits) const {
  octomap::point3d_list found;
  if (tree_->getRoot() != nullptr) tree_->getCentersMinHits(found, min_hits);
  return found;
}

}  // namespace test
}  // namespace rhmap
