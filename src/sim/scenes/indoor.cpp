// SPDX-License-Identifier: BSD-3-Clause
// The scene indoor: a corridor with rooms on both sides.
#include <algorithm>
#include <vector>

#include "../props.hpp"
#include "../scene_builder.hpp"
#include "all.hpp"

namespace rhmap::sim {

namespace {

using Eigen::Vector3d;

constexpr double kSpeed = 0.8;                                    // of the carrier [m/s]
constexpr double kDuration = 70;                                  // [s]
constexpr int kRooms = 9;                                         // on each side
constexpr double kRoom = 8, kRoomDepth = 6, kHalfCorridor = 1.6;  // [m]
constexpr double kDoor = 1.1;                                     // width; in the middle of a room's front
constexpr double kWall = 0.15, kCeiling = 2.8;
constexpr double kFirst = -6, kLast = kFirst + kRoom * kRooms;

double doorX(int room) { return kFirst + kRoom * (room + 0.5); }

void addWalls(SceneBuilder& builder) {
  const double middle = (kFirst + kLast) / 2, length = kLast - kFirst, far = kHalfCorridor + kRoomDepth;
  builder.place(makeBlock(kBuilding, {length, 2 * far, 0.2}, kCeiling), standAt(middle, 0));
  for (const double x : {kFirst, kLast}) builder.place(makeBlock(kBuilding, {kWall, 2 * far, kCeiling}), standAt(x, 0));
  for (const double side : {1.0, -1.0}) {
    builder.place(makeBlock(kBuilding, {length, kWall, kCeiling}), standAt(middle, side * far));
    for (int room = 0; room < kRooms; ++room) {
      const double piece = (kRoom - kDoor) / 2;
      for (const double end : {1.0, -1.0}) {
        builder.place(makeBlock(kBuilding, {piece, kWall, kCeiling}),
                      standAt(doorX(room) + end * (kDoor + piece) / 2, side * kHalfCorridor));
      }
      builder.place(makeBlock(kBuilding, {kDoor, kWall, kCeiling - 2.1}, 2.1),
                    standAt(doorX(room), side * kHalfCorridor));
      if (room > 0) {
        builder.place(makeBlock(kBuilding, {kWall, kRoomDepth, kCeiling}),
                      standAt(kFirst + kRoom * room, side * (kHalfCorridor + kRoomDepth / 2)));
      }
    }
  }
}

void addFurniture(SceneBuilder& builder) {
  Random& random = builder.random();
  for (const double side : {1.0, -1.0}) {
    for (int room = 0; room < kRooms; ++room) {
      const double x = doorX(room);
      builder.place(makeBlock(kOtherObject, {1.6, 0.8, 0.05}, 0.7), standAt(x + random.uniform(1.6, 2.6), side * 4.5));
      builder.place(makeBlock(kOtherObject, {0.9, 0.45, 1.9}), standAt(x - random.uniform(1.5, 3), side * 7.2));
      if (room % 2 == 0) builder.place(makePerson(), standAt(x + random.uniform(-0.4, 0.4), side * 4.4));
    }
  }
  for (double x = kFirst + 2; x < kLast; x += 16)
    builder.place(makeBlock(kOtherObject, {0.8, 0.3, 1.0}), standAt(x, 1.3));
}

void addPeople(SceneBuilder& builder) {
  Random& random = builder.random();
  constexpr double kArmsLength = 0.7;
  // Along the corridor, keeping to their right.
  for (double x = 4; x < kLast + 40; x += random.uniform(5, 9)) {
    const double start = std::min(x, kLast - 0.6);
    const Track walk = pathTrack({{start, 0.85, 0}, {kFirst + 0.6, 0.85, 0}}, 1.3, (x - start) / 1.3);
    builder.moveClearOfEgo(makePerson(), walk, kArmsLength);
  }
  for (double x = 3; x < 30; x += random.uniform(6, 10))
    builder.moveClearOfEgo(makePerson(), pathTrack({{x, -0.85, 0}, {kLast - 0.6, -0.85, 0}}, 1.1, 0), kArmsLength);
  for (int room = 0; room < kRooms; ++room) {
    for (const double side : {1.0, -1.0}) {
      const double x = doorX(room), in = side * 3.2;
      if (room % 2 == (side > 0 ? 0 : 1)) {  // out of the room, along the corridor, into the next
        const double lane = side * 0.85, next = x + (room + 1 < kRooms ? kRoom : -kRoom);
        for (double time = random.uniform(0, 20); time < kDuration; time += random.uniform(15, 30)) {
          const Track walk = pathTrack({{x, in, 0}, {x, lane, 0}, {next, lane, 0}, {next, in, 0}}, 1.2, time);
          if (builder.moveClearOfEgo(makePerson(), walk, kArmsLength)) break;
        }
      } else {  // up and down in the room
        std::vector<Vector3d> points;
        for (int i = 0; i < 30; ++i) points.emplace_back(x + (i % 2 == 0 ? -2.5 : 1.0), side * 3.0, 0);
        builder.move(makePerson(), pathTrack(points, 1.2, -random.uniform(0, 5)));
      }
    }
  }
}

}  // namespace

Scene makeIndoor(std::uint64_t seed) {
  SceneBuilder builder("indoor", seed, straightTrack(standAt(0, 0), kSpeed, 0, kDuration), kDuration);
  builder.terrain() = Terrain(kOtherGround);
  addWalls(builder);
  addFurniture(builder);
  addPeople(builder);
  return builder.take();
}

}  // namespace rhmap::sim
