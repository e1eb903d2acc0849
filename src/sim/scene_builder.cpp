// SPDX-License-Identifier: BSD-3-Clause
#include "scene_builder.hpp"

#include "props.hpp"

namespace rhmap::sim {

SceneBuilder::SceneBuilder(std::string name, std::uint64_t seed, Track ego, double duration) : random_(seed, 0) {
  scene_.name = std::move(name);
  scene_.ego = std::move(ego);
  scene_.duration = duration;
}

void SceneBuilder::place(Object object, const Stance& stance) { move(std::move(object), Track(stance)); }

void SceneBuilder::move(Object object, Track track) {
  const bool is_thing = object.resting >= kCar && object.resting <= kBicyclist;
  object.instance = is_thing ? ++things_ : std::uint16_t{0};
  object.track = std::move(track);
  scene_.objects.push_back(std::move(object));
}

bool SceneBuilder::moveClearOfEgo(Object object, Track track, double distance) {
  for (double time = 0; time <= scene_.duration; time += 0.1) {
    if ((track.at(time).position - scene_.ego.at(time).position).head<2>().norm() < distance) return false;
  }
  move(std::move(object), std::move(track));
  return true;
}

void SceneBuilder::placeTree(const Stance& stance, double clearance, double crown_radius) {
  place(makeTrunk(clearance, crown_radius), stance);
  place(makeCrown(clearance, crown_radius), stance);
}

}  // namespace rhmap::sim
