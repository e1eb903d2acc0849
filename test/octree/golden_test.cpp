// SPDX-License-Identifier: BSD-3-Clause
// Files that stock OctoMap 1.10.0 wrote (data/golden). They change only if OctoMap's formats do: never regenerate them
// from rhmap.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <memory>
#include <sstream>

#include "oracle.hpp"
#include "rhmap/octree/map_file.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {
namespace {

std::string golden(const std::string& name) {
  std::ifstream file(std::string(RHMAP_DATA_DIR) + "/golden/" + name, std::ios::binary);
  EXPECT_TRUE(file) << name;
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class Tree>
class Golden : public testing::Test {};
using Trees = testing::Types<OcTree, test::OctomapOracle>;
TYPED_TEST_SUITE(Golden, Trees);

TYPED_TEST(Golden, AnEmptyMap) {
  TypeParam map(0.1);
  EXPECT_EQ(test::otBytes(map), golden("empty.ot"));
  EXPECT_EQ(test::btBytes(map), golden("empty.bt"));
}

TYPED_TEST(Golden, OneHit) {
  TypeParam map(0.1);
  map.updateNode(OcTreeKey(32768, 32768, 32768), true);
  EXPECT_EQ(test::otBytes(map), golden("one_hit.ot"));
  EXPECT_EQ(test::btBytes(map), golden("one_hit.bt"));
}

class GoldenFile : public testing::TestWithParam<std::string> {};

TEST_P(GoldenFile, IsReadAndWrittenBackByteByByte) {
  const std::string bytes = golden(GetParam());
  const bool binary = GetParam().ends_with(".bt");
  if (binary) {
    OcTree map(0.5);
    std::istringstream in(bytes);
    ASSERT_TRUE(map.readBinary(in));
    EXPECT_EQ(test::btBytes(map), bytes);
  } else {
    std::istringstream in(bytes);
    const std::unique_ptr<AbstractOcTree> map(AbstractOcTree::read(in));
    ASSERT_NE(map, nullptr);
    EXPECT_EQ(test::otBytes(*map), bytes);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, GoldenFile,
                         testing::Values("empty.bt", "empty.ot", "hit_and_miss.bt", "hit_and_miss.ot", "one_color.ot",
                                         "one_counting.ot", "one_stamped.ot", "one_hit.bt", "one_hit.ot",
                                         "pruned_cube.bt", "pruned_cube.ot", "varied_cube.ot", "varied_cube_const.bt",
                                         "varied_cube_ml.bt"),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

TEST(GoldenFile, WriteBinaryOfTheVariedCubeIsItsMaximumLikelihood) {
  std::istringstream in(golden("varied_cube.ot"));
  const std::unique_ptr<AbstractOcTree> read(AbstractOcTree::read(in));
  auto& map = dynamic_cast<OcTree&>(*read);
  EXPECT_EQ(test::btBytes(map), golden("varied_cube_const.bt"));
  std::ostringstream out;
  EXPECT_TRUE(map.writeBinary(out));
  EXPECT_EQ(out.str(), golden("varied_cube_ml.bt"));
}

}  // namespace
}  // namespace rhmap
