// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <locale>
#include <ostream>

#include "../test_files.hpp"

namespace rhmap::test {
namespace {

std::size_t countFiles(const TempFolder& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(folder.path())) ++count;
  return count;
}

TEST(WriteFileWhole, WritesAllBytesAndLeavesNoOtherFile) {
  const TempFolder folder;
  const std::string bytes("line\n\0\r\n\xff", 9);
  writeFileWhole(folder / "a.bin", [&](std::ostream& stream) { stream << bytes; });
  EXPECT_EQ(readText(folder / "a.bin"), bytes);
  EXPECT_EQ(countFiles(folder), 1u);
}

TEST(WriteFileWhole, TheOldFileStaysUntilTheNewOneIsWhole) {
  const TempFolder folder;
  writeText(folder / "a.txt", "old");
  writeFileWhole(folder / "a.txt", [&](std::ostream& stream) {
    stream << "new" << std::flush;
    EXPECT_EQ(readText(folder / "a.txt"), "old");
  });
  EXPECT_EQ(readText(folder / "a.txt"), "new");
}

TEST(WriteFileWhole, AnExceptionOfTheWriterPassesThroughAndLeavesTheOldFile) {
  const TempFolder folder;
  writeText(folder / "a.txt", "old");
  EXPECT_THROW(writeFileWhole(folder / "a.txt",
                              [](std::ostream& stream) {
                                stream << "half";
                                throw std::logic_error("stop");
                              }),
               std::logic_error);
  EXPECT_EQ(readText(folder / "a.txt"), "old");
  EXPECT_EQ(countFiles(folder), 1u);
}

TEST(WriteFileWhole, AStreamThatFailedIsAnErrorAndLeavesTheOldFile) {
  const TempFolder folder;
  writeText(folder / "a.txt", "old");
  expectMessage(messageOf([&] {
                  writeFileWhole(folder / "a.txt", [](std::ostream& stream) {
                    stream << "half";
                    stream.setstate(std::ios::badbit);
                  });
                }),
                {"a.txt", "cannot be written"});
  EXPECT_EQ(readText(folder / "a.txt"), "old");
  EXPECT_EQ(countFiles(folder), 1u);
}

TEST(WriteFileWhole, AFileThatFindsNoRoomIsAnErrorAndLeavesTheOldFile) {
  const TempFolder folder;
  writeText(folder / "a.txt", "old");
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{10, before.rlim_max};  // bytes a file
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = messageOf(
      [&] { writeFileWhole(folder / "a.txt", [](std::ostream& stream) { stream << "more than ten bytes"; }); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  expectMessage(message, {"a.txt", "cannot be written", "File too large"});
  EXPECT_EQ(readText(folder / "a.txt"), "old");
  EXPECT_EQ(countFiles(folder), 1u);
}

TEST(WriteFileWhole, AMissingFolderIsAnError) {
  const TempFolder folder;
  expectMessage(messageOf([&] { writeFileWhole(folder / "none/a.txt", [](std::ostream&) {}); }),
                {"none/a.txt", "cannot be created", "No such file"});
}

TEST(WriteFileWhole, AFolderInThePlaceOfTheFileIsAnErrorAndStays) {
  const TempFolder folder;
  writeText(folder / "a/b.txt", "old");
  expectMessage(messageOf([&] { writeFileWhole(folder / "a", [](std::ostream& stream) { stream << "new"; }); }),
                {"a: cannot be replaced"});
  EXPECT_EQ(readText(folder / "a/b.txt"), "old");
  EXPECT_EQ(countFiles(folder), 1u);
}

TEST(WriteFileWhole, NumbersAreWrittenInTheClassicLocale) {
  struct CommaPoint : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  const TempFolder folder;
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaPoint));
  writeFileWhole(folder / "a.txt", [](std::ostream& stream) { stream << 0.5; });
  std::locale::global(before);
  EXPECT_EQ(readText(folder / "a.txt"), "0.5");
}

}  // namespace
}  // namespace rhmap::test
