// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/large_pages.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace rhmap {

void preferLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  madvise(memory, bytes, MADV_HUGEPAGE);  // advice: nothing is lost where the system does not take it
#endif
}

}  // namespace rhmap
