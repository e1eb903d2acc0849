// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/baseline/resident_memory.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace rhmap {
namespace {

// Sanitizers bring an allocator of their own that keeps what is freed.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kOwnAllocator = true;
#else
constexpr bool kOwnAllocator = false;
#endif

constexpr std::size_t kMegabyte = 1'000'000;

TEST(ResidentMemory, IsThatOfARunningProcess) {
  const auto bytes = residentMemory();
  if (!bytes) GTEST_SKIP() << "no /proc/self/statm";
  EXPECT_GT(*bytes, kMegabyte);
}

TEST(ReleasedMemory, SeesManySmallObjects) {
  if (!residentMemory() || kOwnAllocator) GTEST_SKIP() << "not measurable here";
  constexpr std::size_t kCount = 1'000'000;
  std::vector<std::unique_ptr<int>> objects(kCount);
  for (auto& object : objects) object = std::make_unique<int>(1);
  const auto released = releasedMemory([&] { decltype(objects)().swap(objects); });
  // 8 bytes of the vector and 32 of malloc's smallest piece each.
  EXPECT_NEAR(static_cast<double>(*released), 40. * kCount, 2. * kMegabyte);
}

TEST(ReleasedMemory, IsLittleForNothing) {
  if (!residentMemory()) GTEST_SKIP() << "no /proc/self/statm";
  EXPECT_LT(*releasedMemory([] {}), kMegabyte);
}

TEST(ReleasedMemory, DoesNotCountScratchThatIsFreedAlready) {
  if (!residentMemory() || kOwnAllocator) GTEST_SKIP() << "not measurable here";
  std::vector<std::unique_ptr<int>> scratch(1'000'000);
  for (auto& object : scratch) object = std::make_unique<int>(1);
  auto kept = std::make_unique<std::vector<char>>(10 * kMegabyte, 'x');
  decltype(scratch)().swap(scratch);
  const auto released = releasedMemory([&] { kept.reset(); });
  EXPECT_NEAR(static_cast<double>(*released), 10. * kMegabyte, 1. * kMegabyte);
}

}  // namespace
}  // namespace rhmap
