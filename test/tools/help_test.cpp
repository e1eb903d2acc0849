// SPDX-License-Identifier: BSD-3-Clause
// Help is made of commands that run.
#include <sstream>
#include <vector>

#include "program.hpp"

namespace rhmap::test {
namespace {

struct HelpTest : ProgramTest {
  /// As in a checkout after data/unpack.sh.
  HelpTest() { linkUnpackedData(); }

  /// The commands below "Examples:", without the word rhmap.
  std::vector<std::string> examples(const std::string& help) const {
    const std::string prefix = "  rhmap ";
    std::istringstream lines(help.substr(help.find("Examples:\n")));
    std::vector<std::string> commands;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with(prefix)) commands.push_back(line.substr(prefix.size()));
    }
    return commands;
  }
};

TEST_F(HelpTest, ListsTheVerbs) {
  const std::string help = runs("--help");
  for (const std::string verb : {"build", "clean", "info", "convert", "evaluate", "simulate", "render"})
    EXPECT_NE(help.find("\n  " + verb + " "), std::string::npos) << help;
}

TEST_F(HelpTest, EveryExampleRuns) {
  for (const std::string verb : {"", "build ", "clean ", "info ", "convert ", "evaluate ", "simulate ", "render "}) {
    const auto commands = examples(runs(verb + "--help"));
    EXPECT_GE(commands.size(), 2U) << verb;
    for (const std::string& command : commands) runs(command);
  }
}

TEST_F(HelpTest, NamesTheDefaults) {
  const std::string help = runs("build --help");
  for (const std::string text : {"--resolution M=0.1", "--min-range M=0", "--mapper NAME=rhmap", "--threads N=1"})
    EXPECT_NE(help.find(text), std::string::npos) << text << "\n" << help;
}

TEST_F(HelpTest, VersionIsOneLine) { EXPECT_TRUE(runs("--version").starts_with("rhmap ")); }

}  // namespace
}  // namespace rhmap::test
