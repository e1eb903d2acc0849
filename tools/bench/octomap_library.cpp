// SPDX-License-Identifier: BSD-3-Clause
// OctoMap, compiled here with -O3 -DNDEBUG (see CMakeLists.txt).
#include <cfloat>

#include "quiet_octomap.hpp"
#include "tree_library.hpp"

// What is no template in a node; a definition in the program goes before that in the library. It makes OctoMap a little
// faster than it is for its users (these calls can be inlined here), and lets deleteNode() run: Debian's destructor
// asserts that a node has no array of children, which is not so where the last child was deleted.
namespace octomap {

OcTreeNode::OcTreeNode() : OcTreeDataNode<float>(0.0F) {}
OcTreeNode::~OcTreeNode() {}

void OcTreeNode::addValue(const float& update) { value += update; }

float OcTreeNode::getMaxChildLogOdds() const {
  float max = -FLT_MAX;
  if (children == nullptr) return max;
  for (int i = 0; i < 8; ++i) {
    if (children[i] == nullptr) continue;
    const float value_of_child = static_cast<OcTreeNode*>(children[i])->getLogOdds();
    if (value_of_child > max) max = value_of_child;
  }
  return max;
}

}  // namespace octomap

namespace rhmap::bench {
namespace {

/// OctoMap's node under a name of our own.
class Node final : public octomap::OcTreeNode {};

}  // namespace

std::unique_ptr<Library> makeOctomap(double resolution) {
  return std::make_unique<TreeLibrary<QuietOctomap<Node>, octomap::KeySet>>(resolution);
}

}  // namespace rhmap::bench
