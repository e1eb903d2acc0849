// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/scenes.hpp"

#include <array>
#include <stdexcept>
#include <string>

#include "scenes/all.hpp"

namespace rhmap::sim {

namespace {

constexpr std::array<SceneInfo, 8> kScenes{{
    {"street", "Vans, cars, a bus, cyclists and people between parked cars, trees and facades; 8 m/s", makeStreet},
    {"highway", "Fast traffic on both sides of a guard rail, bridges over it; 25 m/s", makeHighway},
    {"hill", "Slopes, overhanging rock, bridge and branches; cars, a tractor, cyclists, walkers; 6 m/s", makeHill},
    {"crowd", "130 people on a square, a few standing; 1 m/s", makeCrowd},
    {"parking", "Cars that arrive, stop and leave, people among parked cars; 2 m/s", makeParking},
    {"indoor", "A corridor with rooms, furniture and people; 0.8 m/s", makeIndoor},
    {"static", "The street with nothing that moves; 8 m/s", makeStatic},
    {"drive", "3.2 km round four streets and back to the start, with traffic; 8 m/s", makeDrive},
}};

}  // namespace

std::span<const SceneInfo> scenes() { return kScenes; }

Scene makeScene(std::string_view name, std::uint64_t seed) {
  for (const SceneInfo& scene : kScenes) {
    if (scene.name == name) return scene.make(seed);
  }
  std::string message = std::string(name) + " is not a scene; one of:";
  for (const SceneInfo& scene : kScenes) message += (&scene == kScenes.data() ? " " : ", ") + std::string(scene.name);
  throw std::invalid_argument(message);
}

}  // namespace rhmap::sim
