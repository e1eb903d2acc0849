// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace rhmap::test {

inline std::string dataFile(const std::string& name) { return std::string(RHMAP_DATA_DIR "/") + name; }

inline std::string readFile(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error(path.string() + " cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void writeFile(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// What a run of the program left.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// A folder of its own that the program runs in, with the repository's data beside it as `data`.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest() {
    std::string name = (std::filesystem::temp_directory_path() / "rhmap_tools_test_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder " + name);
    folder = name;
    std::filesystem::create_directory_symlink(RHMAP_DATA_DIR, folder / "data");
  }

  ~ProgramTest() override { std::filesystem::remove_all(folder); }

  /// Puts what data/unpack.sh unpacks where it would be in a checkout, build/data.
  void linkUnpackedData() const {
    std::filesystem::create_directory(folder / "build");
    std::filesystem::create_directory_symlink(RHMAP_UNPACKED_DIR, folder / "build/data");
  }

  /// Runs a line of the shell in the folder.
  Outcome shell(const std::string& line) const {
    const std::string logs = folder.string() + ".";
    const int status = std::system(
        ("cd '" + folder.string() + "' && { " + line + "; } >'" + logs + "out' 2>'" + logs + "err' </dev/null")
            .c_str());
    const Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(logs + "out"), readFile(logs + "err")};
    std::filesystem::remove(logs + "out");
    std::filesystem::remove(logs + "err");
    return outcome;
  }

  Outcome rhmap(const std::string& arguments) const { return shell("'" RHMAP_PROGRAM "' " + arguments); }

  /// Runs the program and expects success and silence on stderr.
  std::string runs(const std::string& arguments) const {
    const Outcome outcome = rhmap(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.err;
    EXPECT_EQ(outcome.err, "") << arguments;
    return outcome.out;
  }

  /// Expects that exit code and exactly this one line on stderr.
  void fails(const std::string& arguments, int exit_code, const std::string& line) const {
    const Outcome outcome = rhmap(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments;
    EXPECT_EQ(outcome.err, "rhmap: " + line + "\n") << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
  }

  std::string bytes(const std::string& name) const { return readFile(folder / name); }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder / name); }

  std::filesystem::path folder;
};

}  // namespace rhmap::test
