// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <semaphore>
#include <thread>

namespace rhmap {

/// A thread that does one piece of work after the other while the caller waits: the place to measure one of several
/// maps.
///
/// glibc gives every thread a heap of its own. Two maps that grow in two workers share no page of memory, and neither
/// has to sort the small pieces that the other has freed (after a scan of OctoMap's there are millions of them, and in
/// one heap the next large allocation pays for them, whoever makes it).
class Worker {
 public:
  Worker() = default;
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  ~Worker() {
    work_ = nullptr;
    start_.release();
  }

  /// Returns when `work` is done; what it throws comes out here.
  void run(const std::function<void()>& work) {
    std::exception_ptr error;
    const std::function<void()> guarded = [&] {
      try {
        work();
      } catch (...) {
        error = std::current_exception();
      }
    };
    work_ = &guarded;
    start_.release();
    done_.acquire();
    if (error) std::rethrow_exception(error);
  }

 private:
  void loop() {
    for (start_.acquire(); work_ != nullptr; start_.acquire()) {
      (*work_)();
      done_.release();
    }
  }

  const std::function<void()>* work_ = nullptr;
  std::binary_semaphore start_{0};
  std::binary_semaphore done_{0};
  std::jthread thread_{[this] { loop(); }};  ///< last: it starts with the rest in place and is joined before it goes
};

}  // namespace rhmap
