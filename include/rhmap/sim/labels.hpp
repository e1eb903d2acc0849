// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace rhmap::sim {

/// SemanticKITTI's numbers for what the scenes are made of.
enum Class : std::uint16_t {
  kUnlabelled = 0,
  kCar = 10,
  kBicycle = 11,
  kBus = 13,
  kTruck = 18,
  kOtherVehicle = 20,
  kPerson = 30,
  kBicyclist = 31,
  kRoad = 40,
  kParking = 44,
  kSidewalk = 48,
  kOtherGround = 49,
  kBuilding = 50,
  kFence = 51,
  kOtherStructure = 52,
  kVegetation = 70,
  kTrunk = 71,
  kTerrain = 72,
  kPole = 80,
  kOtherObject = 99,
  kMovingCar = 252,
  kMovingBicyclist = 253,
  kMovingPerson = 254,
  kMovingBus = 257,
  kMovingTruck = 258,
  kMovingOtherVehicle = 259,
};

/// Whether the class says that the thing moves: 252 to 259.
constexpr bool isMoving(std::uint32_t label) { return (label & 0xFFFFU) >= 252 && (label & 0xFFFFU) <= 259; }

/// One point's label: low 16 bits class, high 16 bits instance.
constexpr std::uint32_t toLabel(Class cls, std::uint16_t instance) {
  return static_cast<std::uint32_t>(instance) << 16 | cls;
}

}  // namespace rhmap::sim
