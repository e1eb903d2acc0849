// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/baseline/mapper.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "mappers.hpp"

namespace rhmap {
namespace {

struct Kind {
  std::string_view name;
  std::unique_ptr<Mapper> (*make)(std::string_view name, const MapperConfig& config);
};

constexpr std::array kKinds{Kind{"rhmap", makeRhmapMapper}, Kind{"octomap", makeOctomapMapper}};

constexpr auto kNames = [] {
  std::array<std::string_view, kKinds.size()> names{};
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kKinds[i].name;
  return names;
}();

void validate(const MapperConfig& config) {
  if (!(config.resolution > 0) || !std::isfinite(config.resolution))
    throw std::invalid_argument("MapperConfig::resolution is " + std::to_string(config.resolution) +
                                "; it must be above 0 and finite [m]");
  if (config.num_threads < 1)
    throw std::invalid_argument("MapperConfig::num_threads is " + std::to_string(config.num_threads) +
                                "; it must be at least 1");
}

}  // namespace

std::span<const std::string_view> mapperKinds() { return kNames; }

std::unique_ptr<Mapper> makeMapper(std::string_view kind, const MapperConfig& config) {
  validate(config);
  for (const Kind& known : kKinds) {
    if (known.name == kind) return known.make(known.name, config);
  }
  std::string message = std::string(kind) + " is not a mapper; one of: ";
  for (const Kind& known : kKinds) message.append(known.name).append(&known == &kKinds.back() ? "" : ", ");
  throw std::invalid_argument(message);
}

}  // namespace rhmap
