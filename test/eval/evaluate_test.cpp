// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/eval/evaluate.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "memory_scans.hpp"

namespace rhmap::eval::test {
namespace {

TEST(Evaluate, HasTheBaselinesUnderEveryProtocolAndThenTheRows) {
  const Estimate row = keptBelow(0);
  const auto scores = evaluate(MemoryScans(randomScans(1, 2, 100)), {}, {&row, 1});
  ASSERT_EQ(scores.size(), 9U);
  std::size_t k = 0;
  for (const std::string protocol : {"rhmap", "erasor", "kth"}) {
    for (const std::string name : {"no removal", "oracle", "row"}) {
      EXPECT_EQ(scores[k].protocol, protocol);
      EXPECT_EQ(scores[k++].row, name);
    }
  }
}

TEST(Evaluate, BaselinesAreWhatTheirNamesSay) {
  // Far enough apart that no cell has two kinds.
  std::vector<Labelled> points;
  for (int k = 0; k < 40; ++k) points.push_back({{5.1F + static_cast<float>(k), 0.1F, 0.1F}, k % 4 == 0 ? 252U : 9U});
  for (const std::string protocol : {"rhmap", "erasor", "kth"}) {
    const auto scores = evaluate(MemoryScans({points, points}), only(protocol));
    for (const auto part : {&Score::cells, &Score::points}) {
      if (!(scores[0].*part)) continue;
      EXPECT_EQ((scores[0].*part)->staticKept(), 1.0) << protocol;
      EXPECT_EQ((scores[0].*part)->dynamicRemoved(), 0.0) << protocol;
      EXPECT_EQ((scores[1].*part)->staticKept(), 1.0) << protocol;
      EXPECT_EQ((scores[1].*part)->dynamicRemoved(), 1.0) << protocol;
    }
  }
}

TEST(Evaluate, WithoutMoversHasNoRateOfMovers) {
  for (const Score& score : evaluate(MemoryScans({{{{9, 0, 0}, 9}}}), {})) {
    EXPECT_FALSE((score.cells ? score.cells : score.points)->dynamicRemoved());
    EXPECT_FALSE((score.cells ? score.cells : score.points)->harmonicMean());
  }
}

TEST(Evaluate, AnEmptyScanIsNoError) { EXPECT_EQ(evaluate(MemoryScans(randomScans(1, 1, 0)), {}).size(), 6U); }

TEST(Evaluate, ReadsTheWindowOnlyAndTellsHowFarItIs) {
  const MemoryScans scans({{{{9, 0, 0}, 9}}, {{{8, 0, 0}, 9}}, {{{7, 0, 0}, 9}}});
  EvaluationConfig config;
  config.window = {.first = 1, .last = 2};
  std::size_t reads = 0;
  const auto scores = evaluate(scans, config, {}, [&reads] { ++reads; });
  EXPECT_EQ(reads, 4U);
  EXPECT_EQ(numReads(scans, config), 4U);
  EXPECT_EQ(numReads(scans, only("rhmap")), 3U);
  EXPECT_EQ(scores[0].cells->still, (Survivors{2, 2}));
}

TEST(Evaluate, RefusesWindowsThatAreNotThere) {
  const MemoryScans scans(randomScans(1, 2, 0));
  EvaluationConfig config;
  config.window = {.first = 0, .last = 2};
  EXPECT_THROW(evaluate(scans, config), std::invalid_argument);
  config.window = {.first = 2};
  EXPECT_THROW(evaluate(scans, config), std::invalid_argument);
}

TEST(Evaluate, RefusesLengthsThatAreNone) {
  const MemoryScans scans(randomScans(1, 1, 0));
  for (const double length : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EvaluationConfig cube, voxel, tolerance;
    cube.rhmap->resolution = length;
    voxel.erasor->voxel = length;
    tolerance.kth->tolerance = length;
    for (const EvaluationConfig& config : {cube, voxel, tolerance})
      EXPECT_THROW(evaluate(scans, config), std::invalid_argument);
  }
}

}  // namespace
}  // namespace rhmap::eval::test
