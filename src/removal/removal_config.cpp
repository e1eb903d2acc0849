// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/removal/removal_config.hpp"

#include <array>
#include <stdexcept>
#include <string>

namespace rhmap {
namespace {
constexpr std::array<std::string_view, 3> kProfiles{"paper", "fast", "default"};
}  // namespace

RemovalConfig paperProfile() {
  RemovalConfig config;
  config.protect_hits = false;
  config.shrink_heights = false;
  config.ground.across_regions = false;
  config.context.three_d = true;
  config.context.fov_clamp = false;
  config.context.min_points = 1;
  config.context.min_height = 0;
  config.visibility.enabled = false;
  config.free_space.enabled = false;
  config.back_end.revert_hits = 0;
  return config;
}

RemovalConfig fastProfile() {
  RemovalConfig config;
  config.free_space.enabled = false;
  return config;
}

RemovalConfig defaultProfile() { return {}; }

std::span<const std::string_view> removalProfiles() { return kProfiles; }

RemovalConfig removalProfile(std::string_view name) {
  if (name == "paper") return paperProfile();
  if (name == "fast") return fastProfile();
  if (name == "default") return defaultProfile();
  throw std::invalid_argument("there is no profile " + std::string(name) + "; one of: paper, fast, default");
}

void validate(const RemovalConfig& config) {
  if (config.region_size != 4 && config.region_size != 8 && config.region_size != 16)
    throw std::invalid_argument("RemovalConfig::region_size is " + std::to_string(config.region_size) +
                                ", not 4, 8 or 16");
}

}  // namespace rhmap
