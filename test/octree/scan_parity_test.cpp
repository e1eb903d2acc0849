// SPDX-License-Identifier: BSD-3-Clause
// Real scans on rhmap and on stock OctoMap, byte by byte: every scan of the KITTI clip, spherical_scan.graph and
// scan.dat.
//
// OctoMap takes up to a minute for one scan at 0.05 m, so that not every scan meets every setting here: the settings go
// round with the scans. RHMAP_PARITY=full tries all settings on all scans (hours).
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "../clip.hpp"
#include "oracle.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "rhmap/octree/octree.hpp"
#include "targets.hpp"

namespace rhmap {
namespace {

struct Setting {
  double resolution, max_range;
  bool lazy, discretize;

  std::string text() const {
    return std::to_string(resolution) + " m, range " + std::to_string(max_range) + (lazy ? ", lazy" : "") +
           (discretize ? ", discretize" : "");
  }
};

void PrintTo(const Setting& setting, std::ostream* out) { *out << setting.text(); }

std::vector<Setting> allSettings() {
  std::vector<Setting> settings;
  for (const double resolution : {0.05, 0.1, 0.2, 0.5})
    for (const double max_range : {-1.0, 50.0})
      for (const bool lazy : {false, true})
        for (const bool discretize : {false, true}) settings.push_back({resolution, max_range, lazy, discretize});
  return settings;
}

/// rhmap and OctoMap fed alike.
class Pair {
 public:
  explicit Pair(const Setting& setting) : setting_(setting), ours_(setting.resolution), theirs_(setting.resolution) {
    ours_.setNumThreads(2);
  }

  void insert(const io::Scan& scan) {
    octomap::Pointcloud points = scan.points;
    points.transform(scan.pose);
    ours_.insertPointCloud(points, scan.pose.trans(), setting_.max_range, setting_.lazy, setting_.discretize);
    theirs_.insertPointCloud(points, scan.pose.trans(), setting_.max_range, setting_.lazy, setting_.discretize);
  }

  void expectSame(const std::string& what) {
    if (setting_.lazy) {
      ASSERT_TRUE(test::otBytes(ours_) == test::otBytes(theirs_)) << what << " before updateInnerOccupancy";
      ours_.updateInnerOccupancy();
      theirs_.updateInnerOccupancy();
    }
    ASSERT_EQ(ours_.size(), theirs_.size()) << what;
    ASSERT_TRUE(test::otBytes(ours_) == test::otBytes(theirs_)) << what << " (.ot)";
    ASSERT_TRUE(test::btBytes(ours_) == test::btBytes(theirs_)) << what << " (.bt)";
  }

 private:
  Setting setting_;
  OcTree ours_;
  test::OctomapOracle theirs_;
};

void checkScan(const io::ScanSequence& sequence, std::size_t i, const Setting& setting) {
  Pair pair(setting);
  pair.insert(sequence.scan(i));
  pair.expectSame("scan " + std::to_string(i) + " at " + setting.text());
}

bool full() {
  const char* mode = std::getenv("RHMAP_PARITY");
  return mode != nullptr && std::string(mode) == "full";
}

class ClipParity : public testing::TestWithParam<std::size_t> {};

TEST_P(ClipParity, AScanGivesOctomapsMap) {
  const auto clip = io::openSequence(test::clipFolder());
  const auto settings = allSettings();
  const std::size_t setting = GetParam();
  const bool quick = settings[setting].resolution >= 0.2;
  for (std::size_t i = 0; i < clip->size(); ++i) {
    // Each setting on one scan, and the quick ones also on the scans that are left.
    const bool turn = i == setting || (quick && i >= settings.size() && i % 16 == setting % 16);
    if (full() || turn) {
      ASSERT_NO_FATAL_FAILURE(checkScan(*clip, i, settings[setting]));
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Settings, ClipParity, testing::Range(std::size_t{0}, std::size_t{32}));

class ClipSequenceParity : public testing::TestWithParam<Setting> {};

TEST_P(ClipSequenceParity, AllScansOneAfterTheOtherGiveOctomapsMap) {
  const auto clip = io::openSequence(test::clipFolder());
  ASSERT_GE(clip->size(), 30U);
  Pair pair(GetParam());
  for (std::size_t i = 0; i < clip->size(); ++i) pair.insert(clip->scan(i));
  pair.expectSame(GetParam().text());
}
INSTANTIATE_TEST_SUITE_P(Settings, ClipSequenceParity,
                         testing::Values(Setting{0.2, 30, false, false}, Setting{0.5, -1, false, false},
                                         Setting{0.5, 50, true, false}, Setting{0.5, 50, false, true}));

class ClipOn : public test::OnTarget {};

TEST_P(ClipOn, GivesTheSameMapOnEveryInstructionSetWithAnyNumberOfThreads) {
  const auto clip = io::openSequence(test::clipFolder());
  const auto bytes = [&](int threads) {
    OcTree map(0.2);
    map.setNumThreads(threads);
    for (std::size_t i = 0; i < 3; ++i) {
      const io::Scan scan = clip->scan(10 * i);
      map.insertPointCloud(scan.points, scan.pose.trans(), scan.pose, 50);
    }
    return test::otBytes(map);
  };
  const std::string expected = bytes(1);
  EXPECT_TRUE(bytes(2) == expected);
  EXPECT_TRUE(bytes(5) == expected);
  hwy::SetSupportedTargetsForTest(0);  // as without this test: the widest
  EXPECT_TRUE(bytes(1) == expected);
}
INSTANTIATE_TEST_SUITE_P(Targets, ClipOn, testing::ValuesIn(test::targetsHere()), test::targetName);

TEST(SphericalScan, GivesOctomapsMapAtEverySetting) {
  const auto graph = io::openSequence(std::string(RHMAP_DATA_DIR) + "/maps/spherical_scan.graph");
  for (const Setting& setting : allSettings())
    for (std::size_t i = 0; i < graph->size(); ++i) ASSERT_NO_FATAL_FAILURE(checkScan(*graph, i, setting));
}

TEST(ScanDat, GivesOctomapsMapAtEverySetting) {
  const auto points = io::openSequence(test::unpackedData() / "maps/scan.dat");
  ASSERT_EQ(points->scan(0).points.size(), 88206U);
  for (const Setting& setting : allSettings())
    if (setting.resolution > 0.05 || full()) {
      ASSERT_NO_FATAL_FAILURE(checkScan(*points, 0, setting));
    }
}

}  // namespace
}  // namespace rhmap
