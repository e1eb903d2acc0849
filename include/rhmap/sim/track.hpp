// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace rhmap::sim {

/// Where a thing stands on the ground: x, y and height above the ground [m], heading [rad] from x towards y.
struct Stance {
  Eigen::Vector3d position{0, 0, 0};
  double yaw = 0;
};

struct Waypoint {
  double time = 0;  ///< [s]
  Stance stance;
};

/// A motion: straight and even between waypoints, at rest before the first and after the last.
class Track {
 public:
  /// At rest for ever.
  Track(const Stance& stance) : waypoints_{{0, stance}} {}  // NOLINT: a stance is a track

  /// Throws std::invalid_argument without waypoints or when time runs backwards.
  explicit Track(std::vector<Waypoint> waypoints);

  Stance at(double time) const;

  /// Whether it is at rest somewhere else, or turned, at some time from `first` to `last` [s].
  bool movesWithin(double first, double last) const;

  const std::vector<Waypoint>& waypoints() const { return waypoints_; }

 private:
  std::vector<Waypoint> waypoints_;
};

/// Straight ahead with that speed [m/s], from a stance at time `first` until `last` [s].
Track straightTrack(const Stance& start, double speed, double first, double last);

/// Along a line of points [m] with that speed [m/s] from time `first` [s] on; looks where it goes, or back if
/// `reversed`.
Track pathTrack(const std::vector<Eigen::Vector3d>& points, double speed, double first, bool reversed = false);

/// One after the other, at rest in between; each begins where the one before it ends, and not earlier.
Track joinTracks(const std::vector<Track>& tracks);

}  // namespace rhmap::sim
