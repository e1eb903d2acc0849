// SPDX-License-Identifier: BSD-3-Clause
// The scene parking: rows of bays beside three aisles; cars come and go.
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "../props.hpp"
#include "../scene_builder.hpp"
#include "all.hpp"

namespace rhmap::sim {

namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kDuration = 50;  // [s]
constexpr double kAisle = 17;     // from aisle to aisle [m]
constexpr double kDepth = 5.7;    // from an aisle's middle to that of a bay
constexpr double kBay = 2.8;      // width of a bay
constexpr int kFirstBay = -8, kLastBay = 40;
constexpr double kExit = 112;  // x of the way out

/// A bay: `side` of +1 is to the left of its aisle (aisles -1, 0, 1 are at y = -17, 0, 17).
struct Bay {
  int aisle = 0;
  int side = 1;
  int number = 0;

  double x() const { return kBay * number; }
  double aisleY() const { return kAisle * aisle; }
  bool operator<(const Bay& other) const {
    return std::tie(aisle, side, number) < std::tie(other.aisle, other.side, other.number);
  }
};

/// From the bay's place to the aisle, rear first, with a turn that leaves the nose towards `ahead` (+1: larger x).
std::vector<Vector3d> bayToAisle(const Bay& bay, double ahead) {
  constexpr double kRadius = 3;
  std::vector<Vector3d> points{{bay.x(), bay.aisleY() + bay.side * kDepth, 0}};
  for (int i = 0; i <= 6; ++i) {
    const double angle = kPi / 2 * i / 6;
    points.emplace_back(bay.x() - ahead * kRadius * (1 - std::cos(angle)),
                        bay.aisleY() + bay.side * kRadius * (1 - std::sin(angle)), 0);
  }
  return points;
}

double endTime(const Track& track) { return track.waypoints().back().time; }

/// Out of the bay backwards at a time [s], then to the way out.
Track leave(const Bay& bay, double time) {
  const auto points = bayToAisle(bay, 1);
  const Track back = pathTrack(points, 1.5, time, true);
  return joinTracks({back, pathTrack({points.back(), {kExit, bay.aisleY(), 0}}, 4, endTime(back) + 1)});
}

/// In from the far end at a time [s], and nose first into the bay.
Track arrive(const Bay& bay, double time) {
  auto points = bayToAisle(bay, -1);  // its turn begins on the side of larger x
  points.emplace_back(kExit, bay.aisleY(), 0);
  return pathTrack({points.rbegin(), points.rend()}, 3, time);
}

}  // namespace

Scene makeParking(std::uint64_t seed) {
  // The carrier stops for a while to let somebody out.
  const Track ego =
      joinTracks({straightTrack(standAt(0, 0), 2, 0, 20), straightTrack(standAt(40, 0), 2, 25, kDuration)});
  SceneBuilder builder("parking", seed, ego, kDuration);
  Random& random = builder.random();
  builder.terrain().addPatch({{45, 0}, {75, 28}, 0, kParking});
  for (const int aisle : {-1, 0, 1}) builder.terrain().addPatch({{45, kAisle * aisle}, {75, 3}, 0, kRoad});

  std::set<Bay> taken;
  const auto drive = [&](const Bay& bay, const Track& track) {
    taken.insert(bay);
    builder.moveClearOfEgo(makeCar(), track, 2.6);
  };
  drive({0, -1, 21}, arrive({0, -1, 21}, 0));
  drive({0, 1, 16}, leave({0, 1, 16}, 4));
  drive({0, 1, 30}, leave({0, 1, 30}, 22));
  drive({0, -1, 36}, leave({0, -1, 36}, 40));  // rests in all sequences that end before
  drive({1, -1, 12}, arrive({1, -1, 12}, 1));
  drive({1, 1, 8}, leave({1, 1, 8}, 6));
  drive({-1, 1, 5}, leave({-1, 1, 5}, 2));
  drive({-1, 1, 18}, arrive({-1, 1, 18}, 12));
  const Bay short_stop{-1, 1, 10};  // arrives, stops, leaves
  const Track arrival = arrive(short_stop, 0);
  drive(short_stop, joinTracks({arrival, leave(short_stop, endTime(arrival) + 6)}));

  for (const int aisle : {-1, 0, 1}) {
    for (const int side : {1, -1}) {
      for (int number = kFirstBay; number <= kLastBay; ++number) {
        const Bay bay{aisle, side, number};
        if (taken.count(bay) || !random.chance(0.7)) continue;
        const double turn = (random.chance(0.8) ? side : -side) * kPi / 2 + random.uniform(-0.04, 0.04);
        builder.place(random.chance(0.85) ? makeCar() : makeVan(),
                      standAt(bay.x(), bay.aisleY() + side * kDepth, turn));
      }
    }
  }
  for (int i = 0; i < 12; ++i) {  // to and from their cars, along the aisles
    const double y = kAisle * (i % 3 - 1) + (i % 2 ? 2.6 : -2.6), x = random.uniform(0, 100);
    builder.moveClearOfEgo(makePerson(), straightTrack(standAt(x, y, random.chance(0.5) ? kPi : 0), 1.4, 0, kDuration),
                           1);
  }
  for (int i = 0; i < 4; ++i) builder.place(makePerson(), standAt(random.uniform(10, 100), 8.5));
  for (double x = -30; x < 120; x += 15) {
    for (const double side : {1.0, -1.0}) {
      builder.placeTree(standAt(x, side * 32), 2.2, random.uniform(2, 3));
      builder.place(makeBlock(kFence, {14.8, 0.1, 1.4}), standAt(x + 7.5, side * 29));
      builder.place(makePole(8), standAt(x, side * 8.5));
    }
  }
  builder.place(makeBlock(kBuilding, {50, 20, 8}), standAt(40, 50));
  builder.place(makeBlock(kBuilding, {20, 50, 12}), standAt(-45, 0));
  return builder.take();
}

}  // namespace rhmap::sim
