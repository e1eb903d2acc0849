// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/baseline/worker.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "rhmap/baseline/resident_memory.hpp"

namespace rhmap {
namespace {

TEST(Worker, DoesAllWorkInOneThreadThatIsNotTheCallers) {
  Worker worker;
  std::thread::id first, second;
  worker.run([&] { first = std::this_thread::get_id(); });
  worker.run([&] { second = std::this_thread::get_id(); });
  EXPECT_EQ(first, second);
  EXPECT_NE(first, std::this_thread::get_id());
}

TEST(Worker, HandsOnWhatItsWorkThrowsAndWorksOn) {
  Worker worker;
  EXPECT_THROW(worker.run([] { throw std::runtime_error("no"); }), std::runtime_error);
  bool done = false;
  worker.run([&] { done = true; });
  EXPECT_TRUE(done);
}

TEST(Worker, TellsTheMemoryOfTwoObjectsThatGrewSideBySideApart) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers bring an allocator of their own";
#endif
  if (!residentMemory()) GTEST_SKIP() << "no /proc/self/statm";
  struct Job {
    Worker worker;
    std::vector<std::unique_ptr<int>> objects;
    std::size_t released = 0;
  } jobs[2];
  constexpr int kRounds = 100;
  constexpr int kCount = 5000;
  for (int round = 0; round < kRounds; ++round) {
    for (int k = 0; k < 2; ++k) {
      jobs[k].worker.run([&] {
        for (int i = 0; i < (k + 1) * kCount; ++i) jobs[k].objects.push_back(std::make_unique<int>(i));
      });
    }
  }
  for (Job& job : jobs)
    job.worker.run([&] { job.released = *releasedMemory([&] { decltype(job.objects)().swap(job.objects); }); });
  // 32 bytes of malloc's smallest piece each, and 8 of the touched part of the vector.
  EXPECT_NEAR(static_cast<double>(jobs[0].released), 40. * kRounds * kCount, 2e6);
  EXPECT_NEAR(static_cast<double>(jobs[1].released), 80. * kRounds * kCount, 2e6);
}

}  // namespace
}  // namespace rhmap
