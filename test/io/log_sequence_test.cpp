// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <octomap/ScanGraph.h>

#include <random>

#include "rhmap/io/scan_sequence.hpp"
#include "../test_files.hpp"

namespace rhmap::io::test {
using namespace rhmap::test;
namespace {

class LogSequence : public testing::Test {
 protected:
  std::string readMessage(const std::string& text) const {
    writeText(file_, text);
    return messageOf([this] { openSequence(file_); });
  }

  /// OctoMap's own reader is the oracle: same points and poses, to the last bit.
  void expectOctomapsScans(const std::string& text) const {
    writeText(file_, text);
    octomap::ScanGraph graph;
    graph.readPlainASCII(file_.string());
    const auto sequence = openSequence(file_);
    ASSERT_EQ(sequence->size(), graph.size());
    std::size_t i = 0;
    for (const octomap::ScanNode* node : graph) {
      const Scan scan = sequence->scan(i);
      EXPECT_EQ(sequence->name(i), std::to_string(i));
      EXPECT_EQ(scan.pose, node->pose) << "scan " << i;
      expectSamePoints(scan.points, *node->scan);
      ++i;
    }
  }

  TempFolder folder_;
  std::filesystem::path file_ = folder_ / "scans.log";
};

TEST_F(LogSequence, ReadsWhatOctomapReads) {
  expectOctomapsScans(
      "# two scans and an empty one\n"
      "\n"
      "NODE 1 2 3 0.1 0.2 0.3\n"
      "0.5 -1.25 1e-3\n"
      " this line starts with a blank\n"
      "\t1 2 3\n"
      "# a comment between points\n"
      "+4 5. .6\n"
      "1e-50 -1e-400 1e-40\n"
      "0 0 0\n"
      "NODE -1 0 0 0 0 0\n"
      "NODE 0 0 1.5 0 0 3.14159265\n"
      "7 8 9 100 and more columns\n");
}

TEST_F(LogSequence, RoundsDecimalsAsOctomapDoes) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(-50, 50);
  std::ostringstream text;
  text.precision(17);
  for (int node = 0; node < 20; ++node) {
    text << "NODE";
    for (int k = 0; k < 6; ++k) text << ' ' << uniform(generator);
    text << '\n';
    for (int k = 0; k < 100; ++k) {
      text << uniform(generator) << ' ' << uniform(generator) << '\t' << 1e-3 * uniform(generator) << '\n';
    }
  }
  expectOctomapsScans(text.str());
}

TEST_F(LogSequence, KeepsALastLineWithoutLineEnd) {
  writeText(file_, "NODE 0 0 0 0 0 0\n1 2 3\n4 5 6");
  const Scan scan = openSequence(file_)->scan(0);
  ASSERT_EQ(scan.points.size(), 2u);
  EXPECT_EQ(scan.points[1], octomap::point3d(4, 5, 6));
}

TEST_F(LogSequence, ReadsWindowsLineEnds) {
  writeText(file_, "NODE 0 0 0 0 0 0\r\n\r\n1 2 3\r\n");
  EXPECT_EQ(openSequence(file_)->scan(0).points.size(), 1u);
}

TEST_F(LogSequence, LeavesOutNonFinitePoints) {
  writeText(file_, "NODE 0 0 0 0 0 0\nnan 2 3\n1 inf 1\n1 2 3\n");
  const Scan scan = openSequence(file_)->scan(0);
  EXPECT_EQ(scan.points.size(), 1u);
  EXPECT_EQ(scan.dropped, 2u);
}

TEST_F(LogSequence, ABadLineIsNamed) {
  const std::string good = "NODE 0 0 0 0 0 0\n1 2 3\n";
  expectMessage(readMessage(good + "1 2\n"), {"scans.log", "line 3", "z of a point is missing"});
  expectMessage(readMessage(good + "1 two 3\n"), {"scans.log", "line 3", "y of a point is not a number: 'two'"});
  expectMessage(readMessage(good + "+-1 2 3\n"), {"scans.log", "line 3", "x of a point is not a number: '+-1'"});
  expectMessage(readMessage(good + "1e99 2 3\n"), {"scans.log", "line 3", "x of a point is out of range: '1e99'"});
  expectMessage(readMessage(good + "NODE 0 0 0 0 0\n"), {"scans.log", "line 3", "yaw of a NODE is missing"});
  expectMessage(readMessage(good + "NODE 0 nan 0 0 0 0\n"), {"scans.log", "line 3", "pose of a NODE is not finite"});
  expectMessage(readMessage(good + "NODE 0 0 0 0 inf 0\n"), {"scans.log", "line 3", "pose of a NODE is not finite"});
  expectMessage(readMessage(good + "NODE7 0 0 0 0 0\n"), {"scans.log", "line 3", "starts with NODE"});
}

TEST_F(LogSequence, APointBeforeTheFirstNodeIsAnError) {
  expectMessage(readMessage("# comment\n1 2 3\n"), {"scans.log", "line 2", "before the first NODE"});
}

TEST_F(LogSequence, ALogWithoutScansIsAnError) {
  expectMessage(readMessage(""), {"scans.log", "holds no scans"});
  expectMessage(readMessage("# nothing\n\n"), {"scans.log", "holds no scans"});
}

TEST_F(LogSequence, AnIndexPastTheEndIsOutOfRange) {
  writeText(file_, "NODE 0 0 0 0 0 0\n");
  const auto sequence = openSequence(file_);
  EXPECT_THROW(sequence->scan(1), std::out_of_range);
  EXPECT_THROW(sequence->name(1), std::out_of_range);
}

}  // namespace
}  // namespace rhmap::io::test
