// SPDX-License-Identifier: BSD-3-Clause
// Debian's FCL, which knows nothing but OctoMap, on a mirror: the same collisions, contacts and distances as on stock
// OctoMap.
#include "street.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/geometric_shape_to_BVH_model.h>
#include <fcl/geometry/octree/octree.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "../clip.hpp"

namespace rhmap {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

/// A box, a ball, and a mesh.
std::vector<Geometry> objects() {
  auto mesh = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  fcl::generateBVHModel(*mesh, fcl::Cylinderd(0.4, 1.5), fcl::Transform3d::Identity(), 12, 3);
  return {std::make_shared<fcl::Boxd>(1.8, 0.9, 1.2), std::make_shared<fcl::Sphered>(0.7), mesh};
}

fcl::Transform3d randomPose(std::mt19937& random) {
  const auto real = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = fcl::Vector3d(real(-10, 30), real(-15, 15), real(-1.5, 2));
  pose.linear() = fcl::Quaterniond(real(-1, 1), real(-1, 1), real(-1, 1), real(-1, 1)).normalized().matrix();
  return pose;
}

/// All that a contact says. Its ids of cells are addresses, so they are looked up.
std::vector<double> describe(const fcl::OcTreed& tree, const fcl::Contactd& contact) {
  octomap::OcTreeKey key;
  unsigned depth = 0;
  const auto* node = tree.getNodeByQueryCellId(contact.b1, contact.pos, nullptr, &key, &depth);
  return {contact.pos.x(),
          contact.pos.y(),
          contact.pos.z(),
          contact.normal.x(),
          contact.normal.y(),
          contact.normal.z(),
          contact.penetration_depth,
          node != nullptr ? double{node->getLogOdds()} : -1000.0,
          double(key[0]),
          double(key[1]),
          double(key[2]),
          double(depth)};
}

/// Everything that FCL says about an object at a pose.
struct Answer {
  bool collides;
  std::vector<std::vector<double>> contacts;
  std::vector<double> distance;
  bool operator==(const Answer&) const = default;
};

Answer ask(const std::shared_ptr<fcl::OcTreed>& tree, const Geometry& object, const fcl::Transform3d& pose,
           bool with_distance) {
  const fcl::CollisionObjectd obstacles(tree), robot(object, pose);
  fcl::CollisionResultd collision;
  fcl::collide(&obstacles, &robot, fcl::CollisionRequestd(20, true), collision);
  Answer answer{collision.isCollision(), {}, {}};
  std::vector<fcl::Contactd> contacts;
  collision.getContacts(contacts);
  for (const fcl::Contactd& contact : contacts) answer.contacts.push_back(describe(*tree, contact));
  if (with_distance) {
    fcl::DistanceResultd nearest;
    fcl::distance(&obstacles, &robot, fcl::DistanceRequestd(true), nearest);
    answer.distance = {nearest.min_distance};
    for (const fcl::Vector3d& p : nearest.nearest_points)
      answer.distance.insert(answer.distance.end(), p.data(), p.data() + 3);
  }
  return answer;
}

class Fcl : public testing::Test {
 protected:
  void SetUp() override {
    for (const std::size_t i : {0, 15, 30}) street_.insertScan(i);
    street_.mirror->sync();
    ours_ = std::make_shared<fcl::OcTreed>(street_.mirror);
    theirs_ = std::make_shared<fcl::OcTreed>(street_.stock);
  }

  void expectSameAnswers(int poses) {
    ASSERT_EQ(street_.mirror->size(), street_.stock->size());
    int hits = 0, contacts = 0, far = 0;
    for (int i = 0; i < poses; ++i) {
      const fcl::Transform3d pose = randomPose(random_);
      for (const Geometry& object : objects()) {
        const bool with_distance = i % 25 == 0 && object->getNodeType() != fcl::BV_OBBRSS;  // a mesh takes long
        const Answer ours = ask(ours_, object, pose, with_distance);
        const Answer theirs = ask(theirs_, object, pose, with_distance);
        ASSERT_EQ(ours.collides, theirs.collides) << "pose " << i;
        ASSERT_EQ(ours.contacts, theirs.contacts) << "pose " << i;
        ASSERT_EQ(ours.distance, theirs.distance) << "pose " << i;
        hits += ours.collides;
        contacts += static_cast<int>(ours.contacts.size());
        far += with_distance && ours.distance[0] > 0;
      }
    }
    EXPECT_GT(hits, poses / 10);
    EXPECT_LT(hits, 3 * poses * 9 / 10);
    EXPECT_GT(contacts, hits);
    EXPECT_GT(far, 0);
  }

  test::Street street_{test::clipFolder()};
  std::shared_ptr<fcl::OcTreed> ours_, theirs_;
  std::mt19937 random_{3};
};

TEST_F(Fcl, SeesTheSameOnAMirrorAsOnOctomap) { expectSameAnswers(500); }

TEST_F(Fcl, SeesTheSameAfterTheMapHasChanged) {
  for (int i = 0; i < 500; ++i) {
    const fcl::Vector3d p = randomPose(random_).translation();
    const bool occupied = random_() % 2 == 0;
    street_.map.updateNode(p.x(), p.y(), p.z(), occupied ? 4.0F : -4.0F);
    street_.stock->updateNode(p.x(), p.y(), p.z(), occupied ? 4.0F : -4.0F);
  }
  EXPECT_GT(street_.mirror->sync(), 0U);
  ASSERT_NO_FATAL_FAILURE(expectSameAnswers(300));
  street_.insertScan(43);
  street_.mirror->sync();
  expectSameAnswers(300);
}

}  // namespace
}  // namespace rhmap
