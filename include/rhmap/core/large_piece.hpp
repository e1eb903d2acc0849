// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace rhmap {

/// Size and alignment of the pieces of memory that maps are made of: what one large page of most systems holds.
inline constexpr std::size_t kLargePieceBytes = std::size_t{1} << 21;

/// A piece straight from the system: a heap that is full of small holes, as programs with trees of pointers leave it,
/// has no part in it. Throws std::bad_alloc.
///
/// `as_large_page` asks for one large page. Then the whole of it is occupied with the first write; but it is there with
/// one fault instead of 512, and random access finds it without a walk through the page tables.
void* allocateLargePiece(bool as_large_page);
void freeLargePiece(void* piece) noexcept;

}  // namespace rhmap
