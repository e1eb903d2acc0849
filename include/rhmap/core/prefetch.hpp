// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace rhmap {

/// Asks for all memory of an object that begins with a line of the cache (see BlockIndex::prefetch).
template <class T>
[[gnu::always_inline]] inline void prefetchWhole(const T* object) {
  for (std::size_t line = 0; line < sizeof(T); line += 64)
    __builtin_prefetch(reinterpret_cast<const char*>(object) + line);
}

}  // namespace rhmap
