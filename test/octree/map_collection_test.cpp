// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/map_collection.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "../test_files.hpp"
#include "oracle.hpp"

// OctoMap's castRay tells standard output about each map that it looks at.
#define printf(...) static_cast<void>(0)
#include <octomap/MapCollection.h>
#undef printf

namespace rhmap {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;

using Node = MapNode<OcTree>;
/// What OctoMap's nodes ask of a map.
struct Oracle : test::OctomapOracle {
  using OctomapOracle::OctomapOracle;
  using OctomapOracle::writeBinary;
  bool writeBinary(const std::string& file) {
    std::ofstream s(file, std::ios::binary);
    return writeBinary(s);
  }
};
using OctomapNode = octomap::MapNode<Oracle>;

/// A collection that deletes its nodes, which neither OctoMap's does nor ours.
template <class COLLECTION>
struct Owned : COLLECTION {
  using COLLECTION::COLLECTION;
  Owned() = default;
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() {
    for (auto* node : *this) delete node;
  }
};
using Collection = Owned<MapCollection<Node>>;
using OctomapCollection = Owned<octomap::MapCollection<OctomapNode>>;

std::array<std::uint32_t, 3> bitsOf(const point3d& p) {
  return {std::bit_cast<std::uint32_t>(p.x()), std::bit_cast<std::uint32_t>(p.y()),
          std::bit_cast<std::uint32_t>(p.z())};
}

/// A room with a pillar, hits and misses; the seed moves things around.
OcTree* room(unsigned seed, double resolution = 0.1) {
  auto* map = new OcTree(resolution);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> angle(-3.14F, 3.14F), height(-1, 1);
  octomap::Pointcloud scan;
  for (int i = 0; i < 3000; ++i) {
    const float a = angle(random);
    const float range = std::fabs(a) < 0.3F ? 1.5F : 3.0F;
    scan.push_back(range * std::cos(a), range * std::sin(a), height(random));
  }
  map->insertPointCloud(scan, {0.01F, 0.02F, 0.03F});
  return map;
}

const std::vector<pose6d> kPoses{
    {0, 0, 0, 0, 0, 0}, {1, 2, 0.25F, 0.1, -0.2, 2.5}, {-3, 0.5F, -1, 4.56, 67.3, 1.24}, {2.5F, -2, 0, 0, 0, 0.5}};

/// Four rooms in a file; returns that file.
fs::path writeRooms(const TempFolder& folder) {
  std::string text = "# rooms\n\n";
  for (unsigned i = 0; i < 4; ++i) {
    const std::string name = "room" + std::to_string(i) + ".bt";
    EXPECT_TRUE(std::unique_ptr<OcTree>(room(i))->writeBinary((folder / name).string()));
    std::ostringstream pose;
    pose << kPoses[i].x() << " " << kPoses[i].y() << " " << kPoses[i].z() << " " << kPoses[i].roll() << " "
         << kPoses[i].pitch() << " " << kPoses[i].yaw();
    text += "MAPNODEID the room " + std::to_string(i) + "\n# a comment\nMAPNODEFILENAME " + name + "\nMAPNODEPOSE " +
            pose.str() + "\n";
  }
  test::writeText(folder / "rooms.txt", text);
  return folder / "rooms.txt";
}

/// The same answers to the bit, all over the rooms; how many hits.
std::size_t expectSameAnswers(const MapCollection<Node>& ours, octomap::MapCollection<OctomapNode>& theirs) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-6, 6), direction(-1, 1);
  std::size_t hits = 0, occupied = 0;
  for (int i = 0; i < 20000; ++i) {
    point3d p(place(random), place(random), place(random) / 3);
    if (i % 1000 == 0) p(0) = std::numeric_limits<float>::quiet_NaN();
    if (i % 1000 == 1) p(1) = 1e30F;
    EXPECT_EQ(ours.isOccupied(p), theirs.isOccupied(p)) << p;
    EXPECT_EQ(ours.isOccupied(p.x(), p.y(), p.z()), theirs.isOccupied(p));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(ours.getOccupancy(p)), std::bit_cast<std::uint64_t>(theirs.getOccupancy(p)))
        << p;
    const Node* node = ours.queryNode(p);
    const OctomapNode* octomaps = theirs.queryNode(p);
    EXPECT_EQ(node ? const_cast<Node*>(node)->getId() : "none",
              octomaps ? const_cast<OctomapNode*>(octomaps)->getId() : "none");
    occupied += node != nullptr;

    const point3d along(direction(random), direction(random), i % 2 == 0 ? 0.0F : direction(random));
    for (const bool ignore : {true, false})
      for (const double range : {-1.0, 2.5}) {
        if (ignore && range < 0 && i % 50 != 0) continue;  // through a whole tree of unknown cells
        point3d end(7, 8, 9), octomaps_end(7, 8, 9);
        const bool hit = ours.castRay(p, along, end, ignore, range);
        EXPECT_EQ(hit, theirs.castRay(p, along, octomaps_end, ignore, range)) << p << " along " << along;
        EXPECT_EQ(bitsOf(end), bitsOf(octomaps_end)) << p << " along " << along;
        hits += hit;
      }
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(occupied, 100U);
  return hits;
}

TEST(MapCollection, AnswersLikeOctomapsOnTheSameFile) {
  const TempFolder folder;
  const fs::path file = writeRooms(folder);
  const Collection ours(file.string());
  OctomapCollection theirs(file.string());
  ASSERT_EQ(ours.size(), 4U);
  ASSERT_EQ(theirs.size(), 4U);
  auto octomaps = theirs.begin();
  for (Node* node : ours) {
    EXPECT_EQ(node->getId(), (*octomaps)->getId());
    EXPECT_EQ(node->getOrigin(), (*octomaps)->getOrigin());
    EXPECT_EQ(test::otBytes(*node->getMap()), test::otBytes(*(*octomaps)->getMap()));
    ++octomaps;
  }
  EXPECT_GT(expectSameAnswers(ours, theirs), 1000U);
}

TEST(MapCollection, AnswersLikeOctomapsOnOctomapsExample) {
  const TempFolder folder;
  fs::copy(RHMAP_DATA_DIR "/maps/geb079.bt", folder / "geb079.bt");
  std::string text = "#a comment\n#a comment\n";
  for (const auto* id : {"cup0815", "glass", "cup08w5"})
    text += std::string("MAPNODEID ") + id + "\nMAPNODEFILENAME geb079.bt\nMAPNODEPOSE 1 2 3 4.56 67.3 1.24\n";
  text.pop_back();  // as it is there
  test::writeText(folder / "mapcoll.txt", text);
  const Collection ours((folder / "mapcoll.txt").string());
  OctomapCollection theirs((folder / "mapcoll.txt").string());
  ASSERT_EQ(ours.size(), 3U);
  EXPECT_GT(expectSameAnswers(ours, theirs), 100U);
}

TEST(MapCollection, IsReadByOctomapAsItWasWritten) {
  const TempFolder folder;
  Collection written;
  for (unsigned i = 0; i < 4; ++i) {
    written.addNode(new Node(room(i), kPoses[i]));
    (*(written.end() - 1))->setId("room " + std::to_string(i));
  }
  ASSERT_TRUE(written.write((folder / "out.txt").string()));
  EXPECT_TRUE(fs::exists(folder / "nodemap_room 2.bt"));  // beside it, not in the current folder

  const Collection read((folder / "out.txt").string());
  OctomapCollection octomaps((folder / "out.txt").string());
  ASSERT_EQ(read.size(), 4U);
  ASSERT_EQ(octomaps.size(), 4U);
  for (unsigned i = 0; i < 4; ++i) {
    Node& before = **(written.begin() + i);
    Node& after = **(read.begin() + i);
    EXPECT_EQ(after.getId(), before.getId());
    EXPECT_EQ(test::btBytes(*after.getMap()), test::btBytes(*before.getMap()));
    EXPECT_EQ(after.getOrigin().trans(), before.getOrigin().trans());
    for (unsigned k = 0; k < 4; ++k) EXPECT_NEAR(after.getOrigin().rot()(k), before.getOrigin().rot()(k), 1e-6);
    EXPECT_EQ((*(octomaps.begin() + i))->getOrigin(), after.getOrigin());
  }
  EXPECT_GT(expectSameAnswers(read, octomaps), 1000U);
}

TEST(MapCollection, ReadsWhatOctomapWrote) {
  const TempFolder folder;
  OctomapCollection theirs(writeRooms(folder).string());
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());  // OctoMap writes the maps there
  const bool written = theirs.write("theirs.txt");
  fs::current_path(before);
  ASSERT_TRUE(written);
  OctomapCollection reread((folder / "theirs.txt").string());
  const Collection ours((folder / "theirs.txt").string());
  ASSERT_EQ(ours.size(), 4U);
  EXPECT_GT(expectSameAnswers(ours, reread), 1000U);
}

TEST(MapCollection, KeepsWhateverNamesItsNodesHave) {
  const TempFolder folder;
  const std::vector<std::string> ids{"", "twice", "twice", "a/b", "../../up", "two\nlines", "# no comment", " ", "0"};
  Collection written;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto* map = new OcTree(0.1 + 0.1 * static_cast<double>(i));
    map->updateNode(0.05, 0.05, 0.05, true);
    written.addNode(new Node(map, kPoses[i % 4]));
    (*(written.end() - 1))->setId(ids[i]);
  }
  ASSERT_TRUE(written.write((folder / "out.txt").string()));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()),
            static_cast<std::ptrdiff_t>(ids.size()) + 1);
  const Collection read((folder / "out.txt").string());
  ASSERT_EQ(read.size(), ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Node& node = **(read.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_EQ(node.getId(), i == 0 ? "0" : i == 5 ? "two lines" : ids[i]);
    EXPECT_NEAR(node.getMap()->getResolution(), 0.1 + 0.1 * static_cast<double>(i), 1e-5);
  }
}

TEST(MapCollection, IsWrittenWholeOrNotAtAll) {
  const TempFolder folder;
  Collection good;
  good.addNode(new Node(room(1), kPoses[1]));
  (*good.begin())->setId("a");
  ASSERT_TRUE(good.write((folder / "out.txt").string()));
  const std::string text = test::readText(folder / "out.txt"), map = test::readText(folder / "nodemap_a.bt");

  Collection bad;  // writes a good map under the old name, and then fails
  bad.addNode(new Node(room(2), kPoses[2]));
  (*bad.begin())->setId("a");
  const auto expectOldFiles = [&] {
    EXPECT_FALSE(bad.write((folder / "out.txt").string()));
    EXPECT_EQ(test::readText(folder / "out.txt"), text);
    EXPECT_EQ(test::readText(folder / "nodemap_a.bt"), map);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 2);
  };
  bad.addNode(new Node);  // no map
  expectOldFiles();
  Node* without_map = *(bad.end() - 1);
  EXPECT_TRUE(bad.removeNode(without_map));
  EXPECT_FALSE(bad.removeNode(without_map));
  delete without_map;
  bad.addNode(new Node(room(3), pose6d(std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 0, 0)));
  expectOldFiles();
  (*(bad.end() - 1))->setId(std::string(300, 'x'));  // too long for a file name
  expectOldFiles();
  EXPECT_FALSE(good.write((folder / "no" / "folder.txt").string()));
  EXPECT_FALSE(good.write(folder.path().string()));
  EXPECT_FALSE(good.write(""));
}

std::string errorOf(const fs::path& file) {
  return test::messageOf([&] { readMapCollection<Node>(file); });
}

TEST(DamagedMapCollection, SaysWhatIsWrongAndIsEmpty) {
  const TempFolder folder;
  writeRooms(folder);
  const std::string good = "MAPNODEID a\nMAPNODEFILENAME room1.bt\nMAPNODEPOSE 1 2 3 4 5 6\n";
  const auto expectError = [&](const std::string& text, const std::vector<std::string>& parts) {
    test::writeText(folder / "bad.txt", text);
    test::expectMessage(errorOf(folder / "bad.txt"), parts);
    EXPECT_EQ(MapCollection<Node>((folder / "bad.txt").string()).size(), 0U) << text;
  };
  expectError(good + "MAPNODEID\n", {"bad.txt", "line 4"});
  expectError(good + "MAPNODEID \n", {"bad.txt", "line 4"});
  expectError(good + "MAPNODEID b", {"bad.txt", "ends before the file name"});
  expectError(good + "MAPNODEID b\nMAPNODEFILENAME room1.bt", {"bad.txt", "ends before the pose"});
  expectError(good + "MAPNODEID b\nMAPNODEFILENAME room1.bt\nMAPNODEPOSE 1 2 3", {"bad.txt", "line 6", "1 2 3"});
  expectError(good + "MAPNODEID b\nMAPNODEFILENAME room1.bt\nMAPNODEPOSE 1 2 3 x 5 6", {"bad.txt", "line 6"});
  expectError(good + "MAPNODEID b\nMAPNODEPOSE 1 2 3 4 5 6\nMAPNODEFILENAME room1.bt\n", {"bad.txt", "line 6"});
  expectError(good + "MAPNODEID b\nMAPNODEFILENAME none.bt\nMAPNODEPOSE 1 2 3 4 5 6", {"bad.txt", "none.bt"});
  expectError(good + "MAPNODEID b\nMAPNODEFILENAME rooms.txt\nMAPNODEPOSE 1 2 3 4 5 6", {"bad.txt", "rooms.txt"});
  expectError(good + "MAPNODEID b\nMAPNODEFILENAME .\nMAPNODEPOSE 1 2 3 4 5 6", {"bad.txt"});
  expectError(std::string("\0\1\2\xff", 4), {"bad.txt", "line 1"});
  test::expectMessage(errorOf(folder / "none.txt"), {"none.txt", "cannot be opened"});
  EXPECT_NE(errorOf(folder.path()), "");
  EXPECT_EQ(MapCollection<Node>((folder / "none.txt").string()).size(), 0U);

  test::writeText(folder / "cut.bt", test::readText(folder / "room1.bt").substr(0, 500));
  expectError(good + "MAPNODEID b\nMAPNODEFILENAME cut.bt\nMAPNODEPOSE 1 2 3 4 5 6", {"bad.txt", "cut.bt"});
}

TEST(DamagedMapCollection, CutAnywhereHoldsAllOrNone) {
  const TempFolder folder;
  const std::string text = test::readText(writeRooms(folder));
  for (std::size_t n = 0; n < text.size(); ++n) {
    test::writeText(folder / "cut.txt", text.substr(0, n));
    Collection collection((folder / "cut.txt").string());
    // Cut between two maps, or in the last number of a pose, it is a shorter collection.
    if (collection.size() == 0) continue;
    EXPECT_EQ(errorOf(folder / "cut.txt"), "");
    EXPECT_EQ(OctomapCollection((folder / "cut.txt").string()).size(), collection.size());
  }
}

TEST(MapCollection, ReadsLinesOfOtherSystemsAndEmptyFiles) {
  const TempFolder folder;
  writeRooms(folder);
  test::writeText(folder / "crlf.txt",
                  "# c\r\n\r\n  \r\nMAPNODEID a\r\nMAPNODEFILENAME room1.bt\r\nMAPNODEPOSE 1 2 3 0 0 0\r\n");
  Collection collection((folder / "crlf.txt").string());
  ASSERT_EQ(collection.size(), 1U);
  EXPECT_EQ((*collection.begin())->getId(), "a");
  EXPECT_GT((*collection.begin())->getMap()->size(), 1U);
  test::writeText(folder / "empty.txt", "# nothing\n\n");
  EXPECT_EQ(errorOf(folder / "empty.txt"), "");
  EXPECT_EQ(MapCollection<Node>((folder / "empty.txt").string()).size(), 0U);
}

TEST(MapCollection, FindsNodesAndLeavesThoseWithoutAMapAlone) {
  Node with_map(room(1), kPoses[1]), without_map, of_cloud(octomap::Pointcloud(), kPoses[1]);
  with_map.setId("room");
  MapCollection<Node> collection;
  EXPECT_EQ(collection.getOccupancy({0, 0, 0}), 0.5);
  EXPECT_EQ(collection.addNode(octomap::Pointcloud(), {0, 0, 0}), nullptr);
  collection.addNode(nullptr);
  collection.addNode(&without_map);
  collection.addNode(&of_cloud);
  collection.addNode(&with_map);
  EXPECT_EQ(collection.size(), 4U);
  EXPECT_EQ(collection.queryNode("room"), &with_map);
  EXPECT_EQ(collection.queryNode(std::string("hall")), nullptr);
  EXPECT_EQ(of_cloud.getMap(), nullptr);
  EXPECT_FALSE(without_map.writeMap("/nowhere"));
  EXPECT_EQ(without_map.generatePointcloud().size(), 0U);
  without_map.updateMap(octomap::Pointcloud(), {0, 0, 0});

  const octomap::Pointcloud cloud = with_map.generatePointcloud();
  ASSERT_GT(cloud.size(), 100U);
  for (const point3d& p : cloud) EXPECT_EQ(collection.queryNode(p), &with_map);
  point3d end;
  EXPECT_TRUE(collection.castRay(kPoses[1].trans(), cloud[0] - kPoses[1].trans(), end, true));
  EXPECT_TRUE(collection.isOccupied(end));
  EXPECT_THROW(collection.insertScan(cloud, {0, 0, 0}), std::logic_error);
}

TEST(MapCollection, WritesThePointsOfAllMaps) {
  const TempFolder folder;
  Node a(room(1), kPoses[1]), b(room(2), kPoses[2]);
  MapCollection<Node> collection;
  collection.addNode(&a);
  collection.addNode(&b);
  ASSERT_TRUE(collection.writePointcloud((folder / "points.wrl").string()));
  std::istringstream s(test::readText(folder / "points.wrl"));
  std::string line;
  std::getline(s, line);
  EXPECT_EQ(line, "#VRML V2.0 utf8");
  std::size_t points = 0;
  while (std::getline(s, line)) points += line.ends_with(',');
  EXPECT_EQ(points, a.generatePointcloud().size() + b.generatePointcloud().size());
  EXPECT_FALSE(collection.writePointcloud((folder / "no" / "points.wrl").string()));
}

TEST(MapNode, OfAFileIsNamedAfterIt) {
  const TempFolder folder;
  writeRooms(folder);
  const Node node((folder / "room1.bt").string(), kPoses[1]);
  EXPECT_EQ(node.getId(), (folder / "room1.bt").string());
  EXPECT_EQ(node.getOrigin(), kPoses[1]);
  EXPECT_GT(node.getMap()->size(), 1U);
  const Node none((folder / "none.bt").string(), kPoses[1]);
  EXPECT_EQ(none.getMap()->size(), 0U);
  EXPECT_EQ(none.getMap()->getResolution(), 0.05);
}

}  // namespace
}  // namespace rhmap
