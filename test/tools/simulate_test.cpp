// SPDX-License-Identifier: BSD-3-Clause
#include <regex>

#include "program.hpp"

namespace rhmap::test {
namespace {

struct SimulateTest : ProgramTest {
  void refuses(const std::string& options, const std::string& line) const {
    fails("simulate street out " + options, 2, line + "; see rhmap simulate --help");
    EXPECT_FALSE(exists("out"));
  }
};

TEST_F(SimulateTest, WritesASequenceThatBuildReads) {
  const std::string said = runs("simulate crowd out --beams 16 --frames 2");
  EXPECT_TRUE(std::regex_match(said, std::regex("2 scans, [0-9]+ points, [0-9]+ of them on [0-9]+ moving things\n")))
      << said;
  for (const std::string name : {"velodyne/000001.bin", "labels/000001.label", "poses.txt", "times.txt", "calib.txt"})
    EXPECT_TRUE(exists("out/" + name)) << name;
  EXPECT_EQ(bytes("out/velodyne/000001.bin").size(), 4 * bytes("out/labels/000001.label").size());
  EXPECT_EQ(bytes("out/times.txt"), "0\n0.1\n");
  runs("build out map.bt --resolution 0.4");
}

TEST_F(SimulateTest, TheSameSeedGivesTheSameBytes) {
  const std::string options = " --beams 16 --frames 2 --pose-noise 0.1 --seed ";
  runs("simulate street a" + options + "3");
  runs("simulate street b" + options + "3");
  runs("simulate street c" + options + "4");
  for (const std::string name : {"velodyne/000001.bin", "labels/000001.label", "poses.txt"}) {
    EXPECT_EQ(bytes("a/" + name), bytes("b/" + name)) << name;
    EXPECT_NE(bytes("a/" + name), bytes("c/" + name)) << name;
  }
}

TEST_F(SimulateTest, WrongOptionsAreAnsweredWithRightOnes) {
  fails("simulate moon out", 2,
        "SCENE: moon is not a scene; one of: street, highway, hill, crowd, parking, indoor, static, drive; see rhmap "
        "simulate --help");
  fails("simulate street", 2, "OUT is required; see rhmap simulate --help");
  refuses("--beams 20", "--beams: 20 is not a number of beams; one of: 16, 32, 64, 128");
  refuses("--frames 0", "--frames: 0 is not a number of frames; 1 or more");
  refuses("--rate 0", "--rate: 0 is not a rate above 0; times a second, e.g. 10");
  refuses("--seed x", "--seed: x is not a seed; a whole number, 0 or more");
  refuses("--drop-out 1.5", "--drop-out: 1.5 is not a probability; 0 to 1, e.g. 0.02");
  refuses("--range-noise nan", "--range-noise: nan is not a length; metres, 0 or more, e.g. 2.7");
  refuses("--max-range 0", "--max-range: 0 is not a length above 0; metres, e.g. 0.1");
  refuses("--no-returns one", "--no-returns: one is not a way with no-returns; one of: skip, zero");
}

TEST_F(SimulateTest, ASceneCannotBeStretched) {
  fails("simulate street out --frames 601", 2, "the scene street lasts 60 s: at 10 Hz at most 600 frames");
  EXPECT_FALSE(exists("out"));
}

TEST_F(SimulateTest, AFolderInUseIsLeftAlone) {
  shell("mkdir out && echo mine > out/file");
  fails("simulate street out --beams 16 --frames 1", 1, "out: is not empty");
  EXPECT_EQ(bytes("out/file"), "mine\n");
}

}  // namespace
}  // namespace rhmap::test
