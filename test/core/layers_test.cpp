// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

/// What each layer may include, besides itself.
const std::map<std::string, std::set<std::string>> kMayInclude{
    {"core", {}},
    {"octree", {"core"}},
    {"compat", {"core", "octree"}},
    {"io", {"core", "octree"}},
    {"baseline", {"core", "octree"}},
    {"eval", {"core", "octree", "io"}},
    {"removal", {"core", "octree"}},
    {"render", {"core", "octree"}},
    {"sim", {}},
};

bool isSource(const fs::directory_entry& entry) {
  const fs::path extension = entry.path().extension();
  return entry.is_regular_file() && (extension == ".hpp" || extension == ".cpp" || extension == ".h");
}

TEST(Layers, LookOnlyDown) {
  const std::regex include("#include \"rhmap/([a-z]+)/[^\"]*\"");
  std::size_t includes = 0;
  for (const auto* folder : {"include/rhmap", "src"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(RHMAP_SOURCE_DIR) / folder)) {
      if (!isSource(entry)) continue;
      const std::string layer = fs::relative(entry.path(), fs::path(RHMAP_SOURCE_DIR) / folder).begin()->string();
      ASSERT_TRUE(kMayInclude.count(layer)) << entry.path() << ": a layer that this test does not know";
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        std::smatch match;
        if (!std::regex_search(line, match, include)) continue;
        ++includes;
        EXPECT_TRUE(match[1] == layer || kMayInclude.at(layer).count(match[1])) << entry.path() << ": " << line;
      }
    }
  }
  EXPECT_GT(includes, 20U);
}

TEST(Layers, PublicHeadersNameNeitherPclNorGlNorOpenMp) {
  const std::regex forbidden("#include <(pcl|GL|omp)");
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(RHMAP_SOURCE_DIR) / "include")) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) EXPECT_FALSE(std::regex_search(line, forbidden)) << entry.path();
  }
}

}  // namespace
