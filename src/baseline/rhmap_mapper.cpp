// SPDX-License-Identifier: BSD-3-Clause
#include "mappers.hpp"
#include "rhmap/octree/octree.hpp"
#include "tree_mapper.hpp"

namespace rhmap {

std::unique_ptr<Mapper> makeRhmapMapper(std::string_view name, const MapperConfig& config) {
  return std::make_unique<TreeMapper<OcTree>>(name, config);
}

}  // namespace rhmap
