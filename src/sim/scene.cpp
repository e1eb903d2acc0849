// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/sim/scene.hpp"

#include <algorithm>

namespace rhmap::sim {

namespace {

Eigen::Isometry3d standOn(const Terrain& terrain, const Stance& stance, bool tilts) {
  const double x = stance.position.x(), y = stance.position.y();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << x, y, stance.position.z() + terrain.height(x, y);
  pose.linear() = Eigen::AngleAxisd(stance.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d normal = terrain.normal(x, y);
  if (tilts && normal.z() < 1) {
    pose.linear() =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal).toRotationMatrix() * pose.linear();
  }
  return pose;
}

}  // namespace

Eigen::Isometry3d Scene::objectPose(const Object& object, double time) const {
  return standOn(terrain, object.track.at(time), object.tilts);
}

Eigen::Isometry3d Scene::sensorPose(double time) const {
  return standOn(terrain, ego.at(time), true) * Eigen::Translation3d(0, 0, sensor_height);
}

double boundingRadius(const Object& object) {
  double radius = 0;
  for (const Part& part : object.parts) radius = std::max(radius, part.centre.norm() + halfExtent(part.shape).norm());
  return radius;
}

}  // namespace rhmap::sim
