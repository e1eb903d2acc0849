// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>

namespace rhmap::bench {

/// Processor time of this thread [s].
inline double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Processor time [s] that `work` takes.
template <class F>
double timed(F&& work) {
  const double start = threadSeconds();
  work();
  return threadSeconds() - start;
}

}  // namespace rhmap::bench
