// SPDX-License-Identifier: BSD-3-Clause
#include "street_furniture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "../props.hpp"

namespace rhmap::sim {

namespace {

constexpr double kPi = std::numbers::pi;

void addSidewalk(SceneBuilder& builder, const StreetLine& street, double first, double last, double side) {
  constexpr double kPiece = 20;
  const double width = kSidewalkEnd - kKerb;
  for (double s = first; s < last - 0.1; s += kPiece) {
    const double length = std::min(kPiece, last - s);
    builder.place(makeBlock(kSidewalk, {length, width, kKerbHeight}),
                  street.at(s + length / 2, side * (kKerb + width / 2)));
  }
}

/// Houses side by side; now and then a garden behind a fence.
void addFronts(SceneBuilder& builder, const StreetLine& street, double first, double last, double side) {
  Random& random = builder.random();
  for (double s = first; s < last - 6;) {
    const bool garden = random.chance(0.2);
    const double width = std::min(garden ? random.uniform(6, 12) : random.uniform(10, 22), last - s);
    const double front = kFront + random.uniform(0, 2);
    if (garden) {
      builder.place(makeBlock(kFence, {width, 0.15, 1.2}), street.at(s + width / 2, side * kFront));
      builder.placeTree(street.at(s + width / 2, side * (kFront + 5)), 2.2, random.uniform(2, 3));
    } else {
      const Eigen::Vector3d size(width - 0.3, 10, random.uniform(7, 16));
      builder.place(makeBlock(kBuilding, size), street.at(s + width / 2, side * (front + 5)));
    }
    s += width;
  }
}

void addParkedCars(SceneBuilder& builder, const StreetLine& street, double first, double last, double side) {
  Random& random = builder.random();
  for (double s = first + 4; s < last - 4; s += 6.2) {
    if (!random.chance(0.65)) continue;
    const double turn = (side > 0 ? kPi : 0) + random.uniform(-0.03, 0.03);
    builder.place(random.chance(0.8) ? makeCar() : makeVan(),
                  street.at(s + random.uniform(-0.3, 0.3), side * kParked, turn));
  }
}

void addTreesAndPoles(SceneBuilder& builder, const StreetLine& street, double first, double last, double side) {
  Random& random = builder.random();
  for (double s = first + 6; s < last; s += random.uniform(14, 22))
    builder.placeTree(street.at(s, side * 6.7), 2.7, random.uniform(1.5, 2.2));
  for (double s = first + 15; s < last; s += 35) builder.place(makePole(7), street.at(s, side * 6.3));
}

void addStanding(SceneBuilder& builder, const StreetLine& street, double first, double last, double side) {
  Random& random = builder.random();
  for (double s = first + 10; s < last; s += random.uniform(25, 60)) {
    builder.place(makePerson(), street.at(s, side * 9.2, 0, kKerbHeight));
    builder.place(makeBicycle(), street.at(s + 4, side * (kFront - 0.4), 0, 0));
  }
}

}  // namespace

Stance StreetLine::at(double s, double d, double turn, double z) const {
  const double c = std::cos(yaw), n = std::sin(yaw);
  return {{origin.x() + c * s - n * d, origin.y() + n * s + c * d, z}, yaw + turn};
}

void furnishStreet(SceneBuilder& builder, const StreetLine& street, double first, double last) {
  const Stance middle = street.at((first + last) / 2, 0);
  builder.terrain().addPatch({middle.position.head<2>(), {(last - first) / 2, kKerb}, street.yaw, kRoad});
  for (const double side : {1.0, -1.0}) {
    addSidewalk(builder, street, first, last, side);
    addFronts(builder, street, first, last, side);
    addParkedCars(builder, street, first, last, side);
    addTreesAndPoles(builder, street, first, last, side);
    addStanding(builder, street, first, last, side);
  }
}

void addWalkers(SceneBuilder& builder, const StreetLine& street, double first, double last, double spacing) {
  Random& random = builder.random();
  for (const double side : {1.0, -1.0}) {
    for (double s = first; s < last; s += spacing) {
      const double d = side * random.uniform(7.3, 8.7), speed = random.uniform(1.2, 1.6);
      double ahead = random.chance(0.5) ? 1 : -1;
      std::vector<Eigen::Vector3d> points;
      double here = std::clamp(s + random.uniform(-4, 4), first, last);
      // To the end of the street and back, for as long as anybody looks.
      for (double walked = 0; walked < speed * builder.duration();) {
        points.push_back(street.at(here, d, 0, kKerbHeight).position);
        const double there = ahead > 0 ? last : first;
        walked += std::abs(there - here) + 1e-3;
        here = there;
        ahead = -ahead;
      }
      points.push_back(street.at(here, d, 0, kKerbHeight).position);
      builder.move(makePerson(), pathTrack(points, speed, 0));
    }
  }
}

void addCrossing(SceneBuilder& builder, const StreetLine& street, double s, double time) {
  const double speed = 1.5;
  builder.moveClearOfEgo(
      makePerson(),
      pathTrack({street.at(s, 8, 0, kKerbHeight).position, street.at(s, kKerb, 0, kKerbHeight).position,
                 street.at(s, kKerb, 0, 0).position, street.at(s, -kKerb, 0, 0).position,
                 street.at(s, -kKerb, 0, kKerbHeight).position, street.at(s, -8, 0, kKerbHeight).position},
                speed, time),
      2.5);
}

}  // namespace rhmap::sim
