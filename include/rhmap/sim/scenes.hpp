// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "rhmap/sim/scene.hpp"

namespace rhmap::sim {

struct SceneInfo {
  std::string_view name;
  std::string_view what;  ///< What is in it, in a few words.
  Scene (*make)(std::uint64_t seed);
};

/// All scenes, in the order of the manual.
std::span<const SceneInfo> scenes();

/// The scene of that name, its things placed by the seed; std::invalid_argument if there is none.
Scene makeScene(std::string_view name, std::uint64_t seed);

}  // namespace rhmap::sim
