// SPDX-License-Identifier: BSD-3-Clause
// Real maps read and write back byte by byte. RHMAP_MAPS names a further folder of .bt and .ot files to try.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "oracle.hpp"
#include "rhmap/octree/map_file.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {
namespace {

namespace fs = std::filesystem;

std::string bytesOf(const fs::path& file) {
  std::ifstream s(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(s), {}};
}

/// .bt files of any tree type, and .ot files of OcTrees.
std::vector<fs::path> maps() {
  std::vector<fs::path> folders{fs::path(RHMAP_DATA_DIR) / "maps"};
  if (const char* more = std::getenv("RHMAP_MAPS")) folders.emplace_back(more);
  std::vector<fs::path> files;
  for (const fs::path& folder : folders)
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string extension = entry.path().extension();
      const bool full = extension == ".ot" && bytesOf(entry.path()).find("\nid OcTree\n") < 300;
      if (extension == ".bt" || full) files.push_back(entry.path());
    }
  return files;
}

TEST(RealMap, ReadsAndWritesBackByteByByte) {
  const auto files = maps();
  ASSERT_GE(files.size(), 2U);
  for (const fs::path& file : files) {
    const std::string bytes = bytesOf(file);
    const std::unique_ptr<AbstractOcTree> read = readMapFile(file);
    auto& map = dynamic_cast<OcTree&>(*read);
    std::string written = file.extension() == ".bt" ? test::btBytes(map) : test::otBytes(map);
    const std::string id =
        bytes.substr(bytes.find("\nid ") + 4, bytes.find('\n', bytes.find("\nid ") + 4) - bytes.find("\nid ") - 4);
    if (id != "OcTree")
      written.replace(written.find("id OcTree"), 9, "id " + id);  // OctoMap ignores the id of a .bt, too
    EXPECT_TRUE(written == bytes) << file;
  }
}

TEST(RealMap, HoldsWhatOctomapReadsInIt) {
  for (const fs::path& file : maps()) {
    if (file.extension() != ".bt" || fs::file_size(file) > 1000000) continue;
    OcTree ours(0.1);
    test::OctomapOracle theirs(0.1);
    ASSERT_TRUE(ours.readBinary(file.string()) && theirs.readBinary(file.string()));
    EXPECT_TRUE(test::otBytes(ours) == test::otBytes(theirs)) << file;
    EXPECT_EQ(ours.getNumLeafNodes(), theirs.getNumLeafNodes());
    ours.expand();
    theirs.expand();
    EXPECT_TRUE(test::btBytes(ours) == test::btBytes(theirs)) << file << " expanded";
    ours.prune();
    theirs.prune();
    EXPECT_TRUE(test::otBytes(ours) == test::otBytes(theirs)) << file << " pruned again";
  }
}

}  // namespace
}  // namespace rhmap
