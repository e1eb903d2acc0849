// SPDX-License-Identifier: BSD-3-Clause
#include "props.hpp"

#include <utility>

namespace rhmap::sim {

namespace {

using Eigen::Vector3d;

Part box(const Vector3d& size, const Vector3d& centre) { return {Box{size / 2}, centre}; }

Object vehicle(Class resting, Class moving, std::vector<Part> parts) {
  return {.parts = std::move(parts), .resting = resting, .moving = moving, .tilts = true};
}

/// The wheels are not drawn: light passes below.
constexpr double kUnderside = 0.2;

}  // namespace

Object makeCar() {
  return vehicle(kCar, kMovingCar,
                 {box({4.5, 1.8, 0.7}, {0, 0, kUnderside + 0.35}), box({2.4, 1.6, 0.6}, {-0.2, 0, 1.2})});
}

Object makeVan() {
  return vehicle(
      kCar, kMovingCar,
      {box({4.2, 2.0, 2.1}, {-0.5, 0, kUnderside + 1.05}), box({1.0, 1.9, 1.0}, {2.1, 0, kUnderside + 0.5})});
}

Object makeBus() { return vehicle(kBus, kMovingBus, {box({12, 2.5, 3.0}, {0, 0, kUnderside + 1.5})}); }

Object makeTruck() {
  return vehicle(kTruck, kMovingTruck, {box({8.4, 2.5, 2.8}, {-1.2, 0, 2.4}), box({2.2, 2.4, 2.8}, {4.3, 0, 1.7})});
}

Object makeTractor() {
  return vehicle(kOtherVehicle, kMovingOtherVehicle,
                 {box({1.8, 2.0, 2.5}, {-1.1, 0, 1.55}), box({2.2, 1.0, 1.2}, {0.9, 0, 1.0})});
}

Object makeCyclist() {
  return vehicle(kBicyclist, kMovingBicyclist,
                 {box({1.7, 0.1, 1.0}, {0, 0, 0.5}), {Capsule{0.22, 0.35}, {0, 0, 1.25}}});
}

Object makeBicycle() { return vehicle(kBicycle, kUnlabelled, {box({1.7, 0.1, 1.0}, {0, 0, 0.5})}); }

Object makePerson() {
  return {.parts = {{Capsule{0.25, 0.625}, {0, 0, 0.875}}}, .resting = kPerson, .moving = kMovingPerson};
}

Object makeBlock(Class cls, const Vector3d& size, double bottom) {
  return {.parts = {box(size, {0, 0, bottom + size.z() / 2})}, .resting = cls};
}

Object makeGuardRail(double length) {
  Object rail{.parts = {box({length, 0.1, 0.35}, {0, 0, 0.6})}, .resting = kFence};
  for (const double x : {-length / 4, length / 4}) rail.parts.push_back(box({0.1, 0.15, 0.6}, {x, 0, 0.3}));
  return rail;
}

Object makeTrunk(double clearance, double crown_radius) {
  const double height = clearance + crown_radius / 2;
  return {.parts = {{Cylinder{0.18, height / 2}, {0, 0, height / 2}}}, .resting = kTrunk};
}

Object makeCrown(double clearance, double crown_radius) {
  const Vector3d radii(crown_radius, crown_radius, 0.9 * crown_radius);
  return {.parts = {{Ellipsoid{radii}, {0, 0, clearance + radii.z()}}}, .resting = kVegetation};
}

Object makePole(double height) {
  return {.parts = {{Cylinder{0.08, height / 2}, {0, 0, height / 2}}}, .resting = kPole};
}

}  // namespace rhmap::sim
