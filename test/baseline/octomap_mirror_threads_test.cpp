// SPDX-License-Identifier: BSD-3-Clause
// Between two changes of a map its mirrors may be brought up to date from several threads, while others read the map.
// Built with the thread sanitizer.
#include "../octree/oracle.hpp"

#include "rhmap/baseline/octomap_mirror.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "rhmap/baseline/octomap_bridge.hpp"

namespace rhmap {
namespace {

TEST(OctomapMirrorThreads, SyncCountsAsReadingTheMap) {
  OcTree map(0.1);
  std::vector<std::unique_ptr<OctomapMirror>> mirrors(3);
  std::mt19937 random(4);
  const auto cell = [&] { return static_cast<key_type>(32700 + random() % 60); };
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 300; ++i) map.updateNode(OcTreeKey(cell(), cell(), cell()), random() % 2 == 0);
    if (round == 10) map.clear();
    std::vector<std::jthread> threads;
    for (auto& mirror : mirrors)
      threads.emplace_back([&map, &mirror, round] {
        if (mirror == nullptr || round % 5 == 0) {  // comes and goes, too
          mirror = std::make_unique<OctomapMirror>(map);
        } else {
          mirror->sync();
        }
      });
    threads.emplace_back([&map] { EXPECT_EQ(map.getNumLeafNodes(), OcTree(map).getNumLeafNodes()); });
    threads.clear();
    const auto expected = toOctomap(map);
    for (const auto& mirror : mirrors) ASSERT_TRUE(*mirror == *expected) << "round " << round;
  }
}

}  // namespace
}  // namespace rhmap
