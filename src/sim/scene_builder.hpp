// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "rhmap/sim/random.hpp"
#include "rhmap/sim/scene.hpp"

namespace rhmap::sim {

/// Puts a scene together: numbers the things and keeps the movers out of the carrier's way.
class SceneBuilder {
 public:
  /// The carrier's track and the duration [s] come first: what moves is held against them.
  SceneBuilder(std::string name, std::uint64_t seed, Track ego, double duration);

  Random& random() { return random_; }
  Terrain& terrain() { return scene_.terrain; }
  double duration() const { return scene_.duration; }

  void place(Object object, const Stance& stance);
  void move(Object object, Track track);

  /// Moves it unless it would come within `distance` [m] of the carrier, centre to centre; whether it does.
  bool moveClearOfEgo(Object object, Track track, double distance);

  void placeTree(const Stance& stance, double clearance, double crown_radius);

  Scene take() { return std::move(scene_); }

 private:
  Scene scene_;
  Random random_;
  std::uint16_t things_ = 0;
};

/// Stance at (x, y), `yaw` [rad], its feet at `z` above the ground [m].
inline Stance standAt(double x, double y, double yaw = 0, double z = 0) { return {{x, y, z}, yaw}; }

}  // namespace rhmap::sim
