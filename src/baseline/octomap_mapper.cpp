// SPDX-License-Identifier: BSD-3-Clause
// OctoMap as it should be measured: its templates compiled here, -O3 -DNDEBUG (see CMakeLists.txt).
#include "mappers.hpp"
#include "quiet_octomap.hpp"
#include "tree_mapper.hpp"

namespace rhmap {
namespace {

/// OctoMap's node under a name of our own.
class Node final : public octomap::OcTreeNode {};

}  // namespace

std::unique_ptr<Mapper> makeOctomapMapper(std::string_view name, const MapperConfig& config) {
  return std::make_unique<TreeMapper<QuietOctomap<Node>>>(name, config);
}

}  // namespace rhmap
