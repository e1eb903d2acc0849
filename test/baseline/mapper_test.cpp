// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/baseline/mapper.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace rhmap {
namespace {

constexpr double kResolution = 0.1;
constexpr double kMaxRange = 8;

struct Sweep {
  octomap::Pointcloud points;
  octomap::point3d origin;
};

/// Points around three sensor positions, some of them beyond kMaxRange and some outside of the key space.
std::vector<Sweep> sweeps() {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-6, 6);
  std::vector<Sweep> all(3);
  for (Sweep& sweep : all) {
    sweep.origin = octomap::point3d(coordinate(random), coordinate(random), 1);
    for (int i = 0; i < 400; ++i) sweep.points.push_back(coordinate(random), coordinate(random), coordinate(random));
    sweep.points.push_back(1e6F, 0, 0);
  }
  return all;
}

std::string bytes(const Mapper& mapper, void (Mapper::*write)(std::ostream&) const) {
  std::ostringstream out;
  (mapper.*write)(out);
  return out.str();
}

/// Every kind is held against the class that OctoMap's users have.
class MapperTest : public testing::TestWithParam<std::string_view> {
 protected:
  MapperTest() : mapper(makeMapper(GetParam(), {.resolution = kResolution})), expected(kResolution) {}

  void insertSweeps(double max_range) {
    for (const Sweep& sweep : sweeps()) {
      mapper->insert(sweep.points, sweep.origin, max_range);
      expected.insertPointCloud(sweep.points, sweep.origin, max_range);
    }
  }

  std::unique_ptr<Mapper> mapper;
  octomap::OcTree expected;
};

TEST_P(MapperTest, KnowsItsName) { EXPECT_EQ(mapper->name(), GetParam()); }

TEST_P(MapperTest, StartsEmpty) {
  EXPECT_EQ(mapper->nodeCount(), 0U);
  EXPECT_EQ(mapper->leafCount(), 0U);
}

TEST_P(MapperTest, HasOctomapsNodesAndLeaves) {
  insertSweeps(kMaxRange);
  EXPECT_EQ(mapper->nodeCount(), expected.size());
  EXPECT_EQ(mapper->leafCount(), expected.getNumLeafNodes());
  EXPECT_GT(mapper->memoryUsage(), mapper->nodeCount());
}

TEST_P(MapperTest, WritesOctomapsBytes) {
  insertSweeps(kMaxRange);
  std::ostringstream full, as_is, most_likely;
  expected.write(full);
  expected.writeBinaryConst(as_is);
  expected.writeBinary(most_likely);
  EXPECT_TRUE(bytes(*mapper, &Mapper::write) == full.str());
  EXPECT_TRUE(bytes(*mapper, &Mapper::writeBinaryConst) == as_is.str());
  EXPECT_TRUE(bytes(*mapper, &Mapper::writeBinary) == most_likely.str());
}

TEST_P(MapperTest, HasNoLimitBelowRange0) {
  insertSweeps(-1);
  std::ostringstream full;
  expected.write(full);
  EXPECT_TRUE(bytes(*mapper, &Mapper::write) == full.str());
}

TEST_P(MapperTest, KeepsItsLogOddsWhenItWritesMostLikelyStates) {
  insertSweeps(kMaxRange);
  const std::string before = bytes(*mapper, &Mapper::write);
  bytes(*mapper, &Mapper::writeBinary);
  EXPECT_TRUE(bytes(*mapper, &Mapper::write) == before);
}

TEST_P(MapperTest, SaysNothingOnStderr) {
  testing::internal::CaptureStderr();
  for (const Sweep& sweep : sweeps()) mapper->insert(sweep.points, sweep.origin, -1);
  bytes(*mapper, &Mapper::write);
  bytes(*mapper, &Mapper::writeBinaryConst);
  bytes(*mapper, &Mapper::writeBinary);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

INSTANTIATE_TEST_SUITE_P(All, MapperTest, testing::Values("rhmap", "octomap"),
                         [](const auto& kind) { return std::string(kind.param); });

TEST(MakeMapper, KnowsRhmapAndOctomap) {
  const auto kinds = mapperKinds();
  EXPECT_EQ(std::vector(kinds.begin(), kinds.end()), (std::vector<std::string_view>{"rhmap", "octomap"}));
}

std::string refusal(std::string_view kind, const MapperConfig& config) {
  try {
    makeMapper(kind, config);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(MakeMapper, AnswersAWrongKindWithTheRightOnes) {
  EXPECT_EQ(refusal("foo", {}), "foo is not a mapper; one of: rhmap, octomap");
}

TEST(MakeMapper, NamesTheWrongField) {
  EXPECT_NE(refusal("rhmap", {.resolution = 0}).find("MapperConfig::resolution"), std::string::npos);
  EXPECT_NE(refusal("rhmap", {.num_threads = 0}).find("MapperConfig::num_threads"), std::string::npos);
}

TEST(MakeMapper, GivesTheSameBytesForAnyNumberOfThreads) {
  const auto one = makeMapper("rhmap", {.num_threads = 1});
  const auto four = makeMapper("rhmap", {.num_threads = 4});
  for (const Sweep& sweep : sweeps()) {
    one->insert(sweep.points, sweep.origin, kMaxRange);
    four->insert(sweep.points, sweep.origin, kMaxRange);
  }
  EXPECT_TRUE(bytes(*one, &Mapper::write) == bytes(*four, &Mapper::write));
}

}  // namespace
}  // namespace rhmap
