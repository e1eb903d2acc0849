// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/baseline/resident_memory.hpp"

#include <unistd.h>

#include <cstdlib>
#include <fstream>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace rhmap {
namespace {

/// Gives the pages that malloc keeps for later back to the system.
void trimHeap() {
#ifdef __GLIBC__
  mallopt(M_TRIM_THRESHOLD, 0);
  malloc_trim(0);
  // malloc_trim() leaves the end of a thread's heap alone; freeing a large piece does not.
  constexpr std::size_t kLarge = 100'000;
  void* volatile piece = std::malloc(kLarge);
  std::free(piece);
#endif
}

}  // namespace

std::optional<std::size_t> residentMemory() {
  std::ifstream statm("/proc/self/statm");
  std::size_t total_pages = 0;
  std::size_t resident_pages = 0;
  if (!(statm >> total_pages >> resident_pages)) return std::nullopt;
  return resident_pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::optional<std::size_t> releasedMemory(const std::function<void()>& destroy) {
  trimHeap();
  const auto before = residentMemory();
  destroy();
  trimHeap();
  const auto after = residentMemory();
  if (!before || !after) return std::nullopt;
  return *before > *after ? *before - *after : 0;
}

}  // namespace rhmap
