// SPDX-License-Identifier: BSD-3-Clause
// An example that is a test, too: OMPL plans, with FCL's collision checking, on an rhmap::OcTree through its mirror.
//
//     plan_through_map <folder of scans>
//
// A box on wheels goes down a street. The way is planned on a map of the first scans; later scans bring new obstacles,
// sync() carries them over, and it is planned again. All is held against stock OctoMap. Exit code 0: a way was found
// both times, and FCL's answers were the same on both trees.
#include "street.hpp"

#include <fcl/geometry/octree/octree.h>
#include <fcl/narrowphase/collision.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using rhmap::test::Street;

using Space = ob::SE2StateSpace;

/// Answers whether the robot, a box of 2.4 x 1.2 x 1 m half a metre above the ground, hits something in a tree.
class Checker {
 public:
  explicit Checker(const std::shared_ptr<const octomap::OcTree>& tree)
      : obstacles_(std::make_shared<fcl::OcTreed>(tree)), robot_(std::make_shared<fcl::Boxd>(2.4, 1.2, 1.0)) {}

  bool isFree(const ob::State* state) {
    const auto* at = state->as<Space::StateType>();
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation() = fcl::Vector3d(at->getX(), at->getY(), kHeight);
    pose.linear() = fcl::AngleAxisd(at->getYaw(), fcl::Vector3d::UnitZ()).toRotationMatrix();
    robot_.setTransform(pose);
    fcl::CollisionResultd result;
    fcl::collide(&robot_, &obstacles_, fcl::CollisionRequestd(), result);
    return !result.isCollision();
  }

 private:
  static constexpr double kHeight = -0.7;  // of the box' centre; the street is 1.7 m below the sensor [m]

  fcl::CollisionObjectd obstacles_, robot_;
};

og::PathGeometric plan(const ob::StateSpacePtr& space, Checker& checker) {
  og::SimpleSetup setup(space);
  setup.setStateValidityChecker([&](const ob::State* state) { return checker.isFree(state); });
  setup.getSpaceInformation()->setStateValidityCheckingResolution(0.1 / space->getMaximumExtent());  // every 10 cm
  setup.setPlanner(std::make_shared<og::RRTConnect>(setup.getSpaceInformation()));
  ob::ScopedState<Space> start(space), goal(space);
  start->setXY(8, 1);
  start->setYaw(0);
  goal->setXY(14, 11);
  goal->setYaw(0);
  setup.setStartAndGoalStates(start, goal);
  if (setup.solve(60.0) != ob::PlannerStatus::EXACT_SOLUTION) throw std::runtime_error("no way was found");
  og::PathGeometric path = setup.getSolutionPath();
  setup.getPathSimplifier()->simplifyMax(path);
  path.interpolate();
  return path;
}

void print(const og::PathGeometric& path) {
  std::printf("%zu states, %.1f m:\n", path.getStateCount(), path.length());
  constexpr unsigned kLines = 10;
  for (unsigned line = 0; line <= kLines; ++line) {
    const auto last = static_cast<unsigned>(path.getStateCount() - 1);
    const auto* at = path.getState(line * last / kLines)->as<Space::StateType>();
    std::printf("  x %6.2f m   y %6.2f m   yaw %5.2f\n", at->getX(), at->getY(), at->getYaw());
  }
}

/// The path is free in stock OctoMap's tree, too, and so are or are not the same ones of many other states.
void compare(const ob::StateSpacePtr& space, const og::PathGeometric& path, Checker& ours, Checker& theirs) {
  for (unsigned i = 0; i < path.getStateCount(); ++i)
    if (!theirs.isFree(path.getState(i))) throw std::runtime_error("the path hits something in OctoMap's tree");
  const auto sampler = space->allocDefaultStateSampler();
  ob::ScopedState<Space> state(space);
  int free = 0;
  constexpr int kStates = 5000;
  for (int i = 0; i < kStates; ++i) {
    sampler->sampleUniform(state.get());
    const bool is_free = ours.isFree(state.get());
    if (is_free != theirs.isFree(state.get())) throw std::runtime_error("a state is free in one tree only");
    free += is_free;
  }
  if (free < kStates / 10 || free > kStates * 9 / 10) throw std::runtime_error("the random states say nothing");
  std::printf("the same verdict on %d random states, %d of them free\n", kStates, free);
}

void run(const char* scans) {
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(1);
  Street street(scans);
  const auto space = std::make_shared<Space>();
  ob::RealVectorBounds bounds(2);
  bounds.setLow(0, 0), bounds.setHigh(0, 30);
  bounds.setLow(1, -12), bounds.setHigh(1, 12);
  space->setBounds(bounds);

  Checker ours(street.mirror), theirs(street.stock);
  for (const std::size_t first : {0, 12}) {
    for (std::size_t i = first; i < first + 12; i += 4) street.insertScan(i);
    std::printf("sync: %zu blocks\n", street.mirror->sync());
    const og::PathGeometric path = plan(space, ours);
    print(path);
    compare(space, path, ours, theirs);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: plan_through_map <folder of scans>\n");
    return 2;
  }
  try {
    run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plan_through_map: %s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
