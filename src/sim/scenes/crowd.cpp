// SPDX-License-Identifier: BSD-3-Clause
// The scene crowd: many people on a square.
#include <algorithm>
#include <vector>

#include "../props.hpp"
#include "../scene_builder.hpp"
#include "all.hpp"

namespace rhmap::sim {

namespace {

constexpr double kDuration = 120;                             // [s]; the carrier goes 1 m/s
constexpr double kFirst = -25, kLast = 145, kHalfWidth = 22;  // the square [m]
constexpr double kArmsLength = 0.9;                           // nobody comes nearer to the sensor [m]

/// Straight from place to place, each within sight of the last.
Track strollAbout(Random& random) {
  Eigen::Vector3d place(random.uniform(kFirst + 2, kLast - 2), random.uniform(2 - kHalfWidth, kHalfWidth - 2), 0);
  const double speed = random.uniform(1.1, 1.7);
  std::vector<Eigen::Vector3d> points{place};
  for (double walked = 0; walked < speed * kDuration;) {
    Eigen::Vector3d next = place + Eigen::Vector3d(random.uniform(-25, 25), random.uniform(-20, 20), 0);
    next.x() = std::clamp(next.x(), kFirst + 2, kLast - 2);
    next.y() = std::clamp(next.y(), 2 - kHalfWidth, kHalfWidth - 2);
    if ((next - place).norm() < 3) continue;
    walked += (next - place).norm();
    points.push_back(next);
    place = next;
  }
  return pathTrack(points, speed, 0);
}

}  // namespace

Scene makeCrowd(std::uint64_t seed) {
  SceneBuilder builder("crowd", seed, straightTrack(standAt(0, 0), 1, 0, kDuration), kDuration);
  Random& random = builder.random();
  builder.terrain().addPatch({{(kFirst + kLast) / 2, 0}, {(kLast - kFirst) / 2, kHalfWidth}, 0, kSidewalk});
  for (double x = kFirst; x < kLast; x += 17) {
    for (const double side : {1.0, -1.0})
      builder.place(makeBlock(kBuilding, {16.5, 10, random.uniform(8, 15)}), standAt(x + 8.5, side * (kHalfWidth + 5)));
  }
  for (const double x : {kFirst - 5, kLast + 5}) builder.place(makeBlock(kBuilding, {10, 30, 12}), standAt(x, 0));
  for (double x = kFirst + 10; x < kLast; x += 20) {
    builder.placeTree(standAt(x, 10), 2.6, 2);
    builder.placeTree(standAt(x + 10, -10), 2.6, 2);
    builder.place(makePole(5), standAt(x + 5, 4));
    builder.place(makeBlock(kOtherObject, {1.8, 0.5, 0.45}), standAt(x + 3, -5));  // a bench
  }
  for (int i = 0; i < 10; ++i)
    builder.place(makePerson(), standAt(random.uniform(kFirst + 5, kLast - 5), random.uniform(2, 15)));
  for (int placed = 0; placed < 120;) {
    if (builder.moveClearOfEgo(makePerson(), strollAbout(random), kArmsLength)) ++placed;
  }
  return builder.take();
}

}  // namespace rhmap::sim
