// SPDX-License-Identifier: BSD-3-Clause
#include "removal_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "arguments.hpp"

namespace rhmap::tools {
namespace {

constexpr std::array<std::string_view, 3> kRegionSizes{"4", "8", "16"};
constexpr std::array<std::string_view, 2> kSwitch{"on", "off"};

}  // namespace

void addRemovalOptions(CLI::App& verb, RemovalOptions& options) {
  addResolution(verb, options.resolution, "Edge of the smallest cube");
  verb.add_option("--region-size", options.region_size, "Cubes along a region's edge, one of: 4, 8, 16")
      ->type_name("N")
      ->capture_default_str()
      ->check(oneOf("region size", kRegionSizes));
  verb.add_option("--free-space", options.free_space, "Mark what rays cross as free: on or off")
      ->type_name("on|off")
      ->capture_default_str()
      ->check(oneOf("switch", kSwitch));
  verb.add_flag("--front-end-only", options.front_end_only, "Without the keyframes that look at the map again");
  addMinRange(verb, options.min_range);
  addMaxRange(verb, options.max_range, "Distance beyond which points are dropped");
  addFrames(verb, options.frames);
}

CLI::Validator profileName() { return oneOf("profile", removalProfiles()); }

std::string profileNames() { return fmt::format("{}", fmt::join(removalProfiles(), ", ")); }

RemovalConfig removalConfig(const std::string& profile, const RemovalOptions& options) {
  RemovalConfig config = removalProfile(profile);
  config.region_size = std::stoi(options.region_size);
  config.carve = options.free_space == "on";
  if (options.front_end_only) config.back_end.enabled = false;
  config.min_range = options.min_range;
  if (options.max_range) config.max_range = *options.max_range;
  return config;
}

std::string toText(const RemovalOptions& options) {
  return fmt::format("resolution {} m, regions of {} cubes, range {} m to {}, free space {}, {}", options.resolution,
                     options.region_size, options.min_range,
                     options.max_range ? fmt::format("{} m", *options.max_range) : "any", options.free_space,
                     options.front_end_only ? "front end only" : "front and back end");
}

nlohmann::ordered_json toJson(const RemovalOptions& options) {
  return {{"resolution_m", options.resolution},
          {"region_size", std::stoi(options.region_size)},
          {"free_space", options.free_space == "on"},
          {"back_end", !options.front_end_only},
          {"min_range_m", options.min_range},
          {"max_range_m", options.max_range ? nlohmann::ordered_json(*options.max_range) : nullptr}};
}

}  // namespace rhmap::tools
