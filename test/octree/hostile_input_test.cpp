// SPDX-License-Identifier: BSD-3-Clause
// Map files that are damaged: a clear error and an empty map, never a crash, a hang or half a map.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

#include "../test_files.hpp"
#include "oracle.hpp"
#include "rhmap/octree/map_file.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {
namespace {

OcTree someMap() {
  OcTree map(0.1);
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i)
    map.updateNode(OcTreeKey(static_cast<key_type>(32768 + random() % 20), static_cast<key_type>(32768 + random() % 20),
                             static_cast<key_type>(random() % 10)),
                   random() % 2 == 0);
  return map;
}

std::string errorOf(const std::string& bytes, bool binary) {
  std::istringstream in(bytes);
  try {
    if (binary) {
      OcTree map(0.1);
      readBinaryMap(in, map);
    } else {
      readFullMap(in);
    }
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

const std::string kRest = "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n";
const std::string kBinary = "# Octomap OcTree binary file" + kRest;
const std::string kFull = "# Octomap OcTree file" + kRest;

TEST(DamagedMap, CutAtEveryByteIsAnErrorAndLeavesTheMapEmpty) {
  for (const bool binary : {true, false}) {
    const std::string whole = binary ? test::btBytes(someMap()) : test::otBytes(someMap());
    ASSERT_EQ(errorOf(whole, binary), "");
    for (std::size_t n = 0; n < whole.size(); ++n) {
      ASSERT_NE(errorOf(whole.substr(0, n), binary), "") << n << " of " << whole.size() << " bytes";
      if (binary) {
        OcTree map(0.25);
        map.updateNode(1.0, 1.0, 1.0, true);
        std::istringstream in(whole.substr(0, n));
        ASSERT_FALSE(map.readBinary(in));
        ASSERT_EQ(map.size(), 0U);
        ASSERT_EQ(map.getResolution(), 0.25);
      }
    }
  }
}

TEST(DamagedMap, WithAnyByteChangedIsReadableOrAnError) {
  for (const bool binary : {true, false}) {
    const std::string whole = binary ? test::btBytes(someMap()) : test::otBytes(someMap());
    for (std::size_t n = 0; n < whole.size(); ++n)
      for (const char value : {'\0', '\x7f', '\xff', ' '}) {
        std::string damaged = whole;
        damaged[n] = value;
        errorOf(damaged, binary);
      }
  }
}

TEST(DamagedMap, TheErrorSaysWhatIsWrong) {
  const auto says = [](const std::string& error, const std::string& what) {
    EXPECT_NE(error.find(what), std::string::npos) << error;
  };
  says(errorOf("hello", true), "first line");
  says(errorOf("hello", false), "first line");
  says(errorOf(kFull + "id OcTree\nsize 0\nres 0.1\n", false), "data");
  says(errorOf(kFull + "size 0\nres 0.1\ndata\n", false), "id");
  says(errorOf(kFull + "id OcTree\nsize 0\nres 0\ndata\n", false), "resolution");
  says(errorOf(kFull + "id OcTree\nsize 0\nres -1\ndata\n", false), "resolution");
  says(errorOf(kBinary + "id OcTree\nsize 0\nres nan\ndata\n", true), "resolution");
  says(errorOf(kFull + "id Fish\nsize 0\nres 1\ndata\n", false), "Fish");
  says(errorOf(kBinary + "id OcTree\nsize 4000000000\nres 1\ndata\n" + std::string(2, '\0'), true), "4000000000");
}

TEST(DamagedMap, NodesBelowDepth16AreRefused) {
  std::string full = kFull + "id OcTree\nsize 40\nres 0.1\ndata\n",
              binary = kBinary + "id OcTree\nsize 40\nres 0.1\ndata\n";
  for (int i = 0; i < 40; ++i) {
    full += std::string(4, '\0') + '\x01';
    binary += std::string("\x03\x00", 2);
  }
  EXPECT_NE(errorOf(full, false), "");
  EXPECT_NE(errorOf(binary, true), "");
}

TEST(MapFile, UnknownFieldsAndCommentsAreSkipped) {
  OcTree map(0.1);
  map.updateNode(1.0, 1.0, 1.0, true);
  std::string bytes = test::otBytes(map);
  bytes.insert(bytes.find("size"), "colour of the sea\n# comment data\n");
  std::istringstream in(bytes);
  EXPECT_TRUE(dynamic_cast<OcTree&>(*readFullMap(in)) == map);
}

TEST(MapFile, TheOldestBinaryHeaderIsRead) {
  OcTree map(0.25);
  for (int i = 0; i < 20; ++i) map.updateNode(1.0, 1.0, 1.0, true);
  std::ostringstream data;
  data.write("\3\0\0\0", 4);
  const double resolution = 0.25;
  const auto size = static_cast<std::uint32_t>(map.size());
  data.write(reinterpret_cast<const char*>(&resolution), sizeof resolution);
  data.write(reinterpret_cast<const char*>(&size), sizeof size);
  map.writeBinaryData(data);
  std::istringstream in(data.str());
  OcTree read(0.1);
  ASSERT_TRUE(read.readBinary(in));
  EXPECT_EQ(test::btBytes(read), test::btBytes(map));
}

TEST(MapFile, ReadingIntoAMapThatIsNotEmptyFails) {
  const OcTree map = someMap();
  std::stringstream full, binary;
  map.writeData(full);
  map.writeBinaryData(binary);
  OcTree other = someMap();
  EXPECT_TRUE(other.readData(full).fail());
  EXPECT_TRUE(other.readBinaryData(binary).fail());
  EXPECT_TRUE(other == map);
}

TEST(MapFile, NamesTheFileInItsErrors) {
  const test::TempFolder folder;
  std::ofstream(folder / "broken.bt") << "nothing";
  for (const auto& name : {"broken.bt", "none.ot"}) {
    try {
      readMapFile(folder / name);
      ADD_FAILURE() << name;
    } catch (const std::runtime_error& e) {
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
    }
  }
  EXPECT_EQ(OcTree((folder / "broken.bt").string()).size(), 0U);
  EXPECT_EQ(AbstractOcTree::read((folder / "none.ot").string()), nullptr);
  EXPECT_FALSE(OcTree(0.1).readBinary((folder / "none.bt").string()));
}

TEST(MapFile, WritesWholeFilesOrNone) {
  const test::TempFolder folder;
  OcTree map = someMap();
  EXPECT_FALSE(map.write((folder / "no/such/folder.ot").string()));
  EXPECT_FALSE(map.writeBinary((folder / "no/such/folder.bt").string()));
  EXPECT_TRUE(map.write((folder / "a.ot").string()));
  EXPECT_TRUE(map.writeBinaryConst((folder / "a.bt").string()));
  EXPECT_TRUE(dynamic_cast<OcTree&>(*readMapFile(folder / "a.ot")) == map);
  EXPECT_EQ(readMapFile(folder / "a.bt")->size(), map.size());
}

}  // namespace
}  // namespace rhmap
