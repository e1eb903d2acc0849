// SPDX-License-Identifier: BSD-3-Clause
// Wrong calls: exit code 2 and one line that says what would be right.
#include "program.hpp"

namespace rhmap::test {
namespace {

struct UsageTest : ProgramTest {
  /// A call of `rhmap build` that is right but for `options`.
  void buildRefuses(const std::string& options, const std::string& line) const {
    fails("build data/maps/spherical_scan.graph map.bt " + options, 2, line + "; see rhmap build --help");
    EXPECT_FALSE(exists("map.bt"));
  }
};

TEST_F(UsageTest, AMissingVerbIsAnsweredWithAllVerbs) {
  fails("", 2, "a verb is missing; one of: build, clean, info, compare, convert, evaluate, simulate, render, report");
}

TEST_F(UsageTest, AnUnknownVerbIsAnsweredWithAllVerbs) {
  fails("bild", 2,
        "bild is not a verb; one of: build, clean, info, compare, convert, evaluate, simulate, render, report");
}

TEST_F(UsageTest, AMissingArgumentIsNamed) {
  fails("info", 2, "MAP is required; see rhmap info --help");
  fails("convert data/maps/geb079.bt", 2, "OUT is required; see rhmap convert --help");
}

TEST_F(UsageTest, AnUnknownOptionIsNamed) {
  fails("info data/maps/geb079.bt --bar", 2, "The following argument was not expected: --bar; see rhmap info --help");
}

TEST_F(UsageTest, AnUnknownMapperIsAnsweredWithAllMappers) {
  buildRefuses("--mapper foo", "--mapper: foo is not a mapper; one of: rhmap, octomap");
}

TEST_F(UsageTest, AResolutionIsALengthAbove0) {
  for (const std::string value : {"0", "-1", "nan", "inf", "10cm", "1e999"})
    buildRefuses("--resolution " + value, "--resolution: " + value + " is not a length above 0; metres, e.g. 0.1");
}

TEST_F(UsageTest, AMaximumRangeIsALengthAbove0) {
  buildRefuses("--max-range 0", "--max-range: 0 is not a length above 0; metres, e.g. 0.1");
}

TEST_F(UsageTest, AMinimumRangeIsALength) {
  buildRefuses("--min-range -1", "--min-range: -1 is not a length; metres, 0 or more, e.g. 2.7");
}

TEST_F(UsageTest, ThreadsAreCountedFrom1) {
  for (const std::string value : {"0", "-2", "many", "1.5"})
    buildRefuses("--threads " + value, "--threads: " + value + " is not a number of threads; 1 or more");
}

TEST_F(UsageTest, FramesAreARange) {
  for (const std::string value : {"5-2", "a-b", "1-", "-", "3..4"})
    buildRefuses("--frames=" + value,
                 "--frames: " + value + " is not a range of frames; A-B with A not above B, e.g. 0-9");
}

TEST_F(UsageTest, FramesBeyondTheSequenceAreAnsweredWithThoseItHas) {
  fails("build data/maps/spherical_scan.graph map.bt --frames 0-9", 2,
        "--frames: 0-9 is not in the sequence; it has 0-0");
}

TEST_F(UsageTest, AnUnknownExtensionIsAnsweredWithAllExtensions) {
  fails("build data/maps/spherical_scan.graph map.xyz", 2,
        "MAP: map.xyz has no known extension; one of: .bt, .ot; see rhmap build --help");
  fails("convert data/maps/geb079.bt map", 2,
        "OUT: map has no known extension; one of: .bt, .ot, .ply, .pcd; see rhmap convert --help");
}

TEST_F(UsageTest, AFolderForTheOutputHasToExistBeforeTheWorkBegins) {
  fails("build data/maps/spherical_scan.graph nowhere/map.bt", 2,
        "MAP: nowhere/map.bt: there is no folder nowhere; see rhmap build --help");
  fails("build data/maps/spherical_scan.graph map.bt --json nowhere/summary.json", 2,
        "--json: nowhere/summary.json: there is no folder nowhere; see rhmap build --help");
}

TEST_F(UsageTest, ComparingOctomapWithItselfIsRefused) {
  fails("build data/maps/spherical_scan.graph map.bt --mapper octomap --compare", 2,
        "--compare measures rhmap against OctoMap; leave --mapper octomap out");
}

}  // namespace
}  // namespace rhmap::test
