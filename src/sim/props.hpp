// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "rhmap/sim/scene.hpp"

namespace rhmap::sim {

// What the scenes are furnished with; all stand on the ground at the origin and look along x. Sizes in metres.

Object makeCar();      ///< 4.5 x 1.8 x 1.5
Object makeVan();      ///< 5.2 x 2.0 x 2.3; a car for SemanticKITTI
Object makeBus();      ///< 12 x 2.5 x 3.2
Object makeTruck();    ///< 10.9 x 2.5 x 3.8
Object makeTractor();  ///< 4.0 x 2.0 x 2.8; SemanticKITTI's other vehicle
Object makeCyclist();  ///< 1.7 x 0.44 x 1.82
Object makeBicycle();  ///< 1.7 x 0.1 x 1.0, without a rider
Object makePerson();   ///< 0.5 wide, 1.75 high

/// A trunk that ends in the crown of that clearance and radius, which is an object of its own: another class.
Object makeTrunk(double clearance, double crown_radius);
Object makeCrown(double clearance, double crown_radius);

Object makePole(double height);

/// A box of any stuff with its lower side at `bottom` above the ground.
Object makeBlock(Class cls, const Eigen::Vector3d& size, double bottom = 0);

/// A piece of guard rail of that length along x: a beam on two posts.
Object makeGuardRail(double length);

}  // namespace rhmap::sim
