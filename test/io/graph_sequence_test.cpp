// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <octomap/ScanGraph.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include "rhmap/io/scan_sequence.hpp"
#include "../test_files.hpp"

namespace rhmap::io::test {
using namespace rhmap::test;
namespace {

const std::filesystem::path kData = RHMAP_DATA_DIR;

/// OctoMap's own reader is the oracle: same points and poses, to the last bit.
void expectOctomapsScans(const std::filesystem::path& file) {
  octomap::ScanGraph graph;
  ASSERT_TRUE(graph.readBinary(file.string()));
  const auto sequence = openSequence(file);
  ASSERT_EQ(sequence->size(), graph.size());
  EXPECT_FALSE(sequence->hasLabels());
  std::size_t i = 0;
  for (const octomap::ScanNode* node : graph) {
    const Scan scan = sequence->scan(i);
    EXPECT_EQ(sequence->name(i), std::to_string(node->id));
    EXPECT_EQ(scan.pose, node->pose) << "scan " << i;
    EXPECT_EQ(scan.dropped, 0u);
    EXPECT_TRUE(scan.labels.empty());
    expectSamePoints(scan.points, *node->scan);
    ++i;
  }
}

/// Scans of sizes 3, 0, 1, 50 with random poses, chained by edges, as OctoMap writes them.
void writeGraph(const std::filesystem::path& file, const std::vector<int>& sizes) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<float> uniform(-10, 10);
  octomap::ScanGraph graph;
  for (const int size : sizes) {
    auto* cloud = new octomap::Pointcloud();  // the graph deletes it
    for (int k = 0; k < size; ++k) cloud->push_back(uniform(generator), uniform(generator), uniform(generator));
    graph.addNode(cloud, octomap::pose6d(uniform(generator), uniform(generator), uniform(generator), uniform(generator),
                                         uniform(generator), uniform(generator)));
    graph.connectPrevious();
  }
  graph.writeBinary(file.string());
}

template <typename T>
void patch(const std::filesystem::path& file, std::size_t at, T value) {
  std::string bytes = readText(file);
  ASSERT_LE(at + sizeof(T), bytes.size());
  std::memcpy(&bytes[at], &value, sizeof(T));
  writeText(file, bytes);
}

/// What reading everything says; empty if nothing was thrown.
std::string readMessage(const std::filesystem::path& file) {
  return messageOf([&] {
    const auto sequence = openSequence(file);
    for (std::size_t i = 0; i < sequence->size(); ++i) sequence->scan(i);
  });
}

// Positions in a graph whose first scan has one point: count, points, pose (translation, rotation), id.
constexpr std::size_t kCountAt = 4;
constexpr std::size_t kPointAt = 8;
constexpr std::size_t kPoseAt = kPointAt + 28;
constexpr std::size_t kRotationAt = kPoseAt + 28;

TEST(GraphSequence, ReadsTheSphericalScanAsOctomapDoes) { expectOctomapsScans(kData / "maps/spherical_scan.graph"); }

TEST(GraphSequence, ReadsTheGoldenGraphAsOctomapDoes) { expectOctomapsScans(kData / "golden/two_nodes.graph"); }

TEST(GraphSequence, ReadsSeveralScansAndAnEmptyOneAsOctomapDoes) {
  const TempFolder folder;
  writeGraph(folder / "a.graph", {3, 0, 1, 50});
  expectOctomapsScans(folder / "a.graph");
}

TEST(GraphSequence, KeepsReturnsAtTheSensorAsOctomapDoes) {
  const TempFolder folder;
  octomap::ScanGraph graph;
  auto* cloud = new octomap::Pointcloud();
  cloud->push_back(0, 0, 0);
  graph.addNode(cloud, octomap::pose6d());
  graph.writeBinary((folder / "a.graph").string());
  expectOctomapsScans(folder / "a.graph");
}

TEST(GraphSequence, LeavesOutNonFinitePoints) {
  const TempFolder folder;
  writeGraph(folder / "a.graph", {2});
  patch(folder / "a.graph", kPointAt + 4, std::numeric_limits<double>::quiet_NaN());
  const Scan scan = openSequence(folder / "a.graph")->scan(0);
  EXPECT_EQ(scan.points.size(), 1u);
  EXPECT_EQ(scan.dropped, 1u);
}

TEST(GraphSequence, AFileCutOffAtAnyByteIsAnError) {
  const TempFolder folder;
  writeGraph(folder / "whole.graph", {2, 0, 3});
  const std::string whole = readText(folder / "whole.graph");
  ASSERT_EQ(readMessage(folder / "whole.graph"), "");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    writeText(folder / "cut.graph", whole.substr(0, length));
    EXPECT_NE(readMessage(folder / "cut.graph").find("cut.graph: "), std::string::npos) << length << " bytes";
  }
}

TEST(GraphSequence, AnyDamagedByteIsAnErrorOrReadsAsAnotherGraph) {
  const TempFolder folder;
  writeGraph(folder / "whole.graph", {2, 1});
  const std::string whole = readText(folder / "whole.graph");
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char value : {'\x00', '\x7f', '\xff'}) {
      std::string damaged = whole;
      damaged[at] = value;
      writeText(folder / "damaged.graph", damaged);
      const std::string message = readMessage(folder / "damaged.graph");  // no crash, no hang, no huge allocation
      EXPECT_TRUE(message.empty() || message.find("damaged.graph: ") != std::string::npos) << message;
    }
  }
}

TEST(GraphSequence, ACountThatTheFileCannotHoldIsAnErrorThatNamesTheByte) {
  const TempFolder folder;
  const auto file = folder / "a.graph";
  writeGraph(file, {1, 1});
  patch(file, 0, 0xffffffffu);
  expectMessage(readMessage(file), {"a.graph", "byte 4", "4294967295 x scan", "bytes are left"});
  writeGraph(file, {1, 1});
  patch(file, kCountAt, 0xfffffff0u);
  expectMessage(readMessage(file), {"a.graph", "byte 8", "4294967280 x point", "bytes are left"});
  writeGraph(file, {1});
  patch(file, readText(file).size() - 4, 1u);  // no edges are there
  expectMessage(readMessage(file), {"a.graph", "1 x edge", "only 0 bytes are left"});
}

TEST(GraphSequence, BytesAfterTheEndAreAnError) {
  const TempFolder folder;
  writeGraph(folder / "a.graph", {1});
  writeText(folder / "a.graph", readText(folder / "a.graph") + "xyz");
  expectMessage(readMessage(folder / "a.graph"), {"a.graph", "3 bytes follow the end"});
}

TEST(GraphSequence, WrongDimensionsAreAnErrorThatNamesTheByte) {
  const TempFolder folder;
  const auto file = folder / "a.graph";
  writeGraph(file, {1});
  patch(file, kPointAt, std::int32_t{4});
  expectMessage(readMessage(file), {"a.graph", "byte 8", "point has dimension 4 instead of 3"});
  writeGraph(file, {1});
  patch(file, kPoseAt, std::int32_t{0});
  expectMessage(readMessage(file), {"byte 36", "translation of a pose has dimension 0 instead of 3"});
  writeGraph(file, {1});
  patch(file, kRotationAt, std::int32_t{3});
  expectMessage(readMessage(file), {"byte 64", "rotation of a pose has dimension 3 instead of 4"});
}

TEST(GraphSequence, APoseThatIsNoneIsAnError) {
  const TempFolder folder;
  const auto file = folder / "a.graph";
  writeGraph(file, {1});
  patch(file, kPoseAt + 4, std::numeric_limits<double>::infinity());
  expectMessage(readMessage(file), {"a.graph", "byte 36", "not a pose", "inf"});
  writeGraph(file, {1});
  for (std::size_t k = 0; k < 4; ++k) patch(file, kRotationAt + 4 + 8 * k, 0.0);
  expectMessage(readMessage(file), {"a.graph", "byte 36", "not a pose", "quaternion of length 0.0"});
  writeGraph(file, {1});
  patch(file, kRotationAt + 4, std::nan(""));
  expectMessage(readMessage(file), {"a.graph", "byte 36", "not a pose", "nan"});
}

TEST(GraphSequence, AGraphWithoutScansIsAnError) {
  const TempFolder folder;
  octomap::ScanGraph().writeBinary((folder / "a.graph").string());
  expectMessage(readMessage(folder / "a.graph"), {"a.graph", "holds no scans"});
}

TEST(GraphSequence, AFileThatShrankAfterOpeningIsAnError) {
  const TempFolder folder;
  writeGraph(folder / "a.graph", {5});
  const auto sequence = openSequence(folder / "a.graph");
  for (const std::size_t left : {0u, 5u, 40u}) {
    std::filesystem::resize_file(folder / "a.graph", left);
    expectMessage(messageOf([&] { sequence->scan(0); }), {"a.graph", "byte 8"});
  }
}

TEST(GraphSequence, AnIndexPastTheEndIsOutOfRange) {
  const auto sequence = openSequence(kData / "golden/two_nodes.graph");
  EXPECT_THROW(sequence->scan(2), std::out_of_range);
  EXPECT_THROW(sequence->name(2), std::out_of_range);
}

}  // namespace
}  // namespace rhmap::io::test
