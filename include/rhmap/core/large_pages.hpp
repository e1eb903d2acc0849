// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace rhmap {

/// Pieces of memory of this size and alignment can be a page of their own on most systems.
inline constexpr std::size_t kLargePageBytes = std::size_t{1} << 21;

/// Asks the system to do so for a piece that was not written to yet. Then the whole of it is occupied with the first
/// write; but it is there with one fault instead of 512, and random access finds it without walking the page tables.
void preferLargePages(void* memory, std::size_t bytes) noexcept;

}  // namespace rhmap
