// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "rhmap/sim/scene.hpp"

namespace rhmap::sim {

Scene makeStreet(std::uint64_t seed);
Scene makeHighway(std::uint64_t seed);
Scene makeHill(std::uint64_t seed);
Scene makeCrowd(std::uint64_t seed);
Scene makeParking(std::uint64_t seed);
Scene makeIndoor(std::uint64_t seed);
Scene makeStatic(std::uint64_t seed);
Scene makeDrive(std::uint64_t seed);

}  // namespace rhmap::sim
