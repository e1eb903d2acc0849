// SPDX-License-Identifier: BSD-3-Clause
// A mirror is stock OctoMap's tree after every sync(), and a sync() costs what has changed.
#include "random_maps.hpp"

#include "rhmap/baseline/octomap_mirror.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <optional>

#include "rhmap/baseline/octomap_bridge.hpp"
#include "rhmap/octree/color_octree.hpp"

namespace rhmap {
namespace {

using test::OctomapOracle;
using test::otBytes;
using test::RandomMaps;

/// Every node of a tree by depth and place.
std::map<std::array<unsigned, 4>, const octomap::OcTreeNode*> nodesOf(const octomap::OcTree& tree) {
  std::map<std::array<unsigned, 4>, const octomap::OcTreeNode*> nodes;
  for (auto it = tree.begin_tree(), end = tree.end_tree(); it != end; ++it) {
    const OcTreeKey key = it.getIndexKey();
    nodes[{it.getDepth(), key[0], key[1], key[2]}] = &*it;
  }
  return nodes;
}

class OctomapMirrorOf : public testing::TestWithParam<unsigned> {
 protected:
  void expectSame(OctomapMirror& mirror, RandomMaps& maps) {
    ASSERT_EQ(mirror.size(), maps.theirs().size());
    ASSERT_EQ(mirror.calcNumNodes(), maps.theirs().size());
    ASSERT_TRUE(otBytes(mirror) == otBytes(maps.theirs()));
    ASSERT_EQ(mirror.getResolution(), maps.theirs().getResolution());
    ASSERT_EQ(test::model(mirror), test::model(maps.theirs()));
    const auto copy = toOctomap(maps.ours());
    ASSERT_TRUE(mirror == *copy);
    ASSERT_EQ(test::bounds(mirror), test::bounds(*copy)) << "OctoMap caches them";
  }
};

TEST_P(OctomapMirrorOf, RandomMapsIsTheTreeThatOctomapWouldHold) {
  RandomMaps maps(GetParam());
  OctomapMirror often(maps.ours()), seldom(maps.ours());
  std::optional<OctomapMirror> now_and_then;
  bool often_needs_all = false, seldom_needs_all = false;
  const BlockObserver witness = maps.ours().store().observe();
  maps.ours().store().takeChanges(witness);
  for (int i = 0; i < 800; ++i) {
    maps.step();
    if (maps.wroteByPointer()) often_needs_all = seldom_needs_all = true;
    if (maps.below(i < 200 ? 3 : 15) == 0) {
      const BlockChanges changes = maps.ours().store().takeChanges(witness);
      const bool all = std::exchange(often_needs_all, false);
      const std::size_t blocks = all ? often.syncAll() : often.sync();
      if (!all && !changes.all) {
        ASSERT_LE(blocks, changes.blocks.size()) << "it had to help itself by rewriting everything: call " << i;
      }
      ASSERT_NO_FATAL_FAILURE(expectSame(often, maps)) << "call " << i;
      ASSERT_EQ(often.sync(), 0U);
    } else if (maps.below(60) == 0) {
      std::exchange(seldom_needs_all, false) ? seldom.syncAll() : seldom.sync();
      ASSERT_NO_FATAL_FAILURE(expectSame(seldom, maps)) << "call " << i;
    } else if (maps.below(50) == 0) {
      now_and_then.emplace(maps.ours());
      ASSERT_NO_FATAL_FAILURE(expectSame(*now_and_then, maps)) << "call " << i;
    }
  }
}

TEST_P(OctomapMirrorOf, RandomMapsKeepsTheAddressesOfNodesThatStay) {
  RandomMaps maps(GetParam());
  OctomapMirror mirror(maps.ours());
  for (int i = 0; i < 100; ++i) {
    for (int n = maps.below(12); n >= 0; --n) maps.step();
    const auto before = nodesOf(mirror);
    maps.below(10) == 0 ? mirror.syncAll() : mirror.sync();
    std::size_t kept = 0;
    for (const auto& [place, node] : nodesOf(mirror)) {
      const auto it = before.find(place);
      if (it == before.end()) continue;
      ASSERT_EQ(it->second, node) << "call " << i;
      ++kept;
    }
    if (!before.empty() && mirror.size() != 0) {
      ASSERT_GT(kept, 0U) << "at least the root";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, OctomapMirrorOf, testing::Range(1U, 17U));

/// A hilly plain of 300 x 300 cells under open sky.
void makePlain(OcTree& map) {
  std::mt19937 random(1);
  for (int x = 0; x < 300; ++x)
    for (int y = 0; y < 300; ++y) {
      const int ground = static_cast<int>(random() % 3);
      for (int z = 0; z < 12; ++z)
        map.updateNode(OcTreeKey(static_cast<key_type>(32700 + x), static_cast<key_type>(32700 + y),
                                 static_cast<key_type>(32700 + z)),
                       z <= ground);
    }
}

std::size_t blockCount(const OcTree& map) {
  std::size_t blocks = 0;
  map.store().forEachBlock([&](const Block&) { ++blocks; });
  return blocks;
}

TEST(OctomapMirror, RewritesOnlyWhatHasChanged) {
  OcTree map(0.1);
  makePlain(map);
  OctomapMirror mirror(map);
  ASSERT_GT(blockCount(map), 1500U);
  EXPECT_EQ(mirror.sync(), 0U);
  EXPECT_EQ(mirror.syncAll(), blockCount(map));

  map.updateNode(OcTreeKey(32800, 32800, 32702), true);
  EXPECT_LE(mirror.sync(), 6U) << "the region and the five levels above it";
  EXPECT_TRUE(mirror == *toOctomap(map));

  map.updateNode(OcTreeKey(32800, 32800, 32702), true, true);
  EXPECT_EQ(mirror.sync(), 1U) << "lazily the region alone";
  EXPECT_TRUE(mirror == *toOctomap(map));
  map.updateInnerOccupancy();
  EXPECT_EQ(mirror.sync(), blockCount(map)) << "this may have changed everything";
  EXPECT_TRUE(mirror == *toOctomap(map));

  map.deleteNode(OcTreeKey(32801, 32800, 32702));
  EXPECT_LE(mirror.sync(), 6U);
  EXPECT_TRUE(mirror == *toOctomap(map));

  while (map.search(OcTreeKey(32810, 32810, 32710))->getLogOdds() > map.getClampingThresMinLog())
    map.updateNode(OcTreeKey(32810, 32810, 32710), false);
  mirror.sync();
  map.updateNode(OcTreeKey(32810, 32810, 32710), false);
  octomap::Pointcloud scan;
  scan.push_back(map.keyToCoord(OcTreeKey(32810, 32810, 32710)));
  map.insertPointCloud(scan, scan[0]);
  mirror.sync();
  EXPECT_EQ(mirror.sync(), 0U);

  octomap::Pointcloud points;
  for (int i = 0; i < 20; ++i)
    points.push_back(map.keyToCoord(OcTreeKey(32950, static_cast<key_type>(32900 + i), 32705)));
  map.insertPointCloud(points, map.keyToCoord(OcTreeKey(32940, 32910, 32708)));
  const std::size_t blocks = mirror.sync();
  EXPECT_GT(blocks, 6U);
  EXPECT_LE(blocks, 40U);
  EXPECT_TRUE(mirror == *toOctomap(map));
  map.prune();
  EXPECT_EQ(mirror.sync(), 0U) << "nothing is left to prune";
  EXPECT_TRUE(mirror == *toOctomap(map));
}

TEST(OctomapMirror, SeesARegionThatIsPrunedAwayAndComesBack) {
  OcTree map(0.1);
  OctomapMirror mirror(map);
  const auto fill = [&](float value) {
    for (key_type x = 0; x < 16; ++x)
      for (key_type y = 0; y < 16; ++y)
        for (key_type z = 0; z < 16; ++z) map.setNodeValue(OcTreeKey(x, y, z), value);
  };
  fill(1);
  mirror.sync();
  ASSERT_EQ(mirror.size(), 13U) << "one leaf at depth 12";
  map.updateNode(OcTreeKey(3, 3, 3), false);
  EXPECT_LE(mirror.sync(), 6U);
  EXPECT_TRUE(mirror == *toOctomap(map));
  map.setNodeValue(OcTreeKey(3, 3, 3), 1);
  EXPECT_LE(mirror.sync(), 6U);
  EXPECT_EQ(mirror.size(), 13U);
  EXPECT_TRUE(mirror == *toOctomap(map));
  map.clear();
  EXPECT_EQ(mirror.sync(), 0U);
  EXPECT_EQ(mirror.getRoot(), nullptr);
  EXPECT_EQ(mirror.size(), 0U);
}

TEST(OctomapMirror, ShowsARootWithoutChildren) {
  OcTree map(0.1), root(0.1);
  OctomapMirror mirror(map);
  EXPECT_EQ(test::bounds(mirror), std::vector<double>(6, 0.0)) << "OctoMap caches them";
  root.updateNode(1, 1, 1, true);
  for (unsigned i = 0; i < 8; ++i) root.deleteNodeChild(root.getRoot(), i);
  map.swapContent(root);
  mirror.sync();
  EXPECT_EQ(mirror.size(), 1U);
  EXPECT_TRUE(mirror == *toOctomap(map));
  EXPECT_EQ(test::bounds(mirror), test::bounds(*toOctomap(map)));
  EXPECT_NE(test::bounds(mirror), std::vector<double>(6, 0.0));
}

TEST(OctomapMirror, FollowsItsTreeWhereTreesSwapTheirNodes) {
  OcTree a(0.1), b(0.2);
  OctomapMirror of_a(a), of_b(b);
  a.updateNode(1, 1, 1, true);
  b.updateNode(-1, 2, 3, true);
  b.updateNode(-1, 2, 4, true);
  of_a.sync(), of_b.sync();
  a.swapContent(b);
  a.updateNode(3, 3, 3, true);
  of_a.sync(), of_b.sync();
  EXPECT_TRUE(of_a == *toOctomap(a));
  EXPECT_TRUE(of_b == *toOctomap(b));
  {
    OcTree c(0.1);
    c.updateNode(5, 5, 5, true);
    a.swapContent(c);
  }
  EXPECT_TRUE(of_a.connected());
  of_a.sync();
  EXPECT_TRUE(of_a == *toOctomap(a));
  a.updateNode(5, 5, 6, true);
  of_a.sync();
  EXPECT_TRUE(of_a == *toOctomap(a));
}

TEST(OctomapMirror, StaysAsItIsWhenTheMapGoes) {
  auto map = std::make_unique<OcTree>(0.1);
  map->updateNode(1, 1, 1, true);
  OctomapMirror mirror(*map);
  const std::string bytes = otBytes(mirror);
  EXPECT_TRUE(mirror.connected());
  map.reset();
  EXPECT_FALSE(mirror.connected());
  EXPECT_EQ(mirror.sync(), 0U);
  EXPECT_EQ(mirror.syncAll(), 0U);
  EXPECT_EQ(otBytes(mirror), bytes);
}

TEST(OctomapMirror, MayGoBeforeTheMap) {
  OcTree map(0.1);
  { OctomapMirror mirror(map); }
  for (int i = 0; i < 1000; ++i) map.updateNode(i * 0.7, 0, 0, true);
  EXPECT_TRUE(OctomapMirror(map) == *toOctomap(map));
}

TEST(OctomapMirror, FindsWhatWasWrittenThroughPointersIfToldToLookAtAll) {
  OcTree map(0.1);
  makePlain(map);
  OctomapMirror mirror(map);
  map.search(OcTreeKey(32800, 32800, 32702))->setLogOdds(0.125F);
  EXPECT_EQ(mirror.sync(), 0U);
  EXPECT_FALSE(mirror == *toOctomap(map));
  mirror.syncAll();
  EXPECT_TRUE(mirror == *toOctomap(map));

  // octomap_server's way to clear a box.
  for (auto it = map.begin_leafs_bbx(OcTreeKey(32720, 32720, 32700), OcTreeKey(32730, 32730, 32710)),
            end = map.end_leafs_bbx();
       it != end; ++it)
    it->setLogOdds(map.getClampingThresMinLog());
  map.updateInnerOccupancy();
  mirror.sync();
  EXPECT_TRUE(mirror == *toOctomap(map));
}

TEST(OctomapMirror, RecoversFromWhatOthersDoToIt) {
  OcTree map(0.1);
  makePlain(map);
  OctomapMirror mirror(map);
  mirror.clear();
  map.updateNode(OcTreeKey(32800, 32800, 32702), true);
  mirror.sync();
  EXPECT_TRUE(mirror == *toOctomap(map));
}

TEST(OctomapMirror, ShowsTheOccupancyOfAColourMap) {
  ColorOcTree map(0.1);
  OctomapOracle oracle(0.1);
  BasicOctomapMirror<ColorOcTreeNode> mirror(map);
  std::mt19937 random(2);
  const auto cell = [&] { return static_cast<key_type>(32760 + random() % 8); };
  for (int i = 0; i < 20000; ++i) {
    const OcTreeKey key(cell(), cell(), cell());
    const bool hit = random() % 4 == 0;
    map.updateNode(key, hit);
    oracle.updateNode(key, hit);
    map.averageNodeColor(key, static_cast<std::uint8_t>(i), 0, 9);
    if (i % 500 != 0) continue;
    EXPECT_LE(mirror.sync(), 8U + 5U);
    ASSERT_TRUE(otBytes(mirror) == otBytes(oracle)) << i;
    ASSERT_TRUE(otBytes(*toOctomap(map)) == otBytes(oracle)) << i;
  }
}

}  // namespace
}  // namespace rhmap
