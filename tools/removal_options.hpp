// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "rhmap/removal/removal_config.hpp"

namespace rhmap::tools {

/// What the verbs that run the removal of dynamic objects have in common; defaults are RemovalConfig's.
struct RemovalOptions {
  double resolution = 0.1;  ///< edge of a cube [m]
  std::string region_size = std::to_string(RemovalConfig{}.region_size);
  std::string free_space = RemovalConfig{}.carve ? "on" : "off";
  bool front_end_only = false;
  double min_range = RemovalConfig{}.min_range;  ///< nearer points are dropped [m]
  std::optional<double> max_range;               ///< farther points are dropped [m]
  std::string frames;                            ///< "A-B"; empty: all
};

/// All of them but --profile, of which a verb takes one or several.
void addRemovalOptions(CLI::App& verb, RemovalOptions& options);

/// Accepts the profiles' names.
CLI::Validator profileName();

/// "paper, fast, default", for a help text.
std::string profileNames();

/// The profile with the options on top.
RemovalConfig removalConfig(const std::string& profile, const RemovalOptions& options);

/// The settings in a line: "resolution 0.1 m, regions of 8 cubes, ...".
std::string toText(const RemovalOptions& options);

/// The settings as members of a JSON object.
nlohmann::ordered_json toJson(const RemovalOptions& options);

}  // namespace rhmap::tools
