// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/track.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace rhmap::sim {

namespace {

using Eigen::Vector3d;

bool same(const Stance& a, const Stance& b) { return a.position == b.position && a.yaw == b.yaw; }

double wrapAngle(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

}  // namespace

Track::Track(std::vector<Waypoint> waypoints) : waypoints_(std::move(waypoints)) {
  if (waypoints_.empty()) throw std::invalid_argument("Track: no waypoints");
  for (std::size_t i = 1; i < waypoints_.size(); ++i) {
    if (!(waypoints_[i - 1].time <= waypoints_[i].time)) throw std::invalid_argument("Track: time runs backwards");
  }
}

Stance Track::at(double time) const {
  const auto next = std::upper_bound(waypoints_.begin(), waypoints_.end(), time,
                                     [](double t, const Waypoint& waypoint) { return t < waypoint.time; });
  if (next == waypoints_.begin()) return waypoints_.front().stance;
  if (next == waypoints_.end()) return waypoints_.back().stance;
  const Waypoint& last = *std::prev(next);
  const double part = (time - last.time) / (next->time - last.time);
  return {last.stance.position + part * (next->stance.position - last.stance.position),
          last.stance.yaw + part * wrapAngle(next->stance.yaw - last.stance.yaw)};
}

bool Track::movesWithin(double first, double last) const {
  for (std::size_t i = 1; i < waypoints_.size(); ++i) {
    const Waypoint& a = waypoints_[i - 1];
    const Waypoint& b = waypoints_[i];
    if (!same(a.stance, b.stance) && a.time < last && b.time > first) return true;
  }
  return false;
}

Track straightTrack(const Stance& start, double speed, double first, double last) {
  Stance end = start;
  const double length = speed * (last - first);
  end.position += Vector3d(std::cos(start.yaw) * length, std::sin(start.yaw) * length, 0);
  return Track({{first, start}, {last, end}});
}

Track pathTrack(const std::vector<Vector3d>& points, double speed, double first, bool reversed) {
  std::vector<Waypoint> waypoints;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) first += (points[i] - points[i - 1]).norm() / speed;
    const Vector3d along = points[std::min(i + 1, points.size() - 1)] - points[i == 0 ? 0 : i - 1];
    const double yaw = std::atan2(along.y(), along.x()) + (reversed ? std::numbers::pi : 0);
    waypoints.push_back({first, {points[i], yaw}});
  }
  return Track(std::move(waypoints));
}

Track joinTracks(const std::vector<Track>& tracks) {
  std::vector<Waypoint> waypoints;
  for (const Track& track : tracks)
    waypoints.insert(waypoints.end(), track.waypoints().begin(), track.waypoints().end());
  return Track(std::move(waypoints));
}

}  // namespace rhmap::sim
