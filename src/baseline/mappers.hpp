// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "rhmap/baseline/mapper.hpp"

namespace rhmap {

/// Each in a source file of its own, because OctoMap's is compiled with its own flags.
std::unique_ptr<Mapper> makeRhmapMapper(std::string_view name, const MapperConfig& config);
std::unique_ptr<Mapper> makeOctomapMapper(std::string_view name, const MapperConfig& config);

}  // namespace rhmap
