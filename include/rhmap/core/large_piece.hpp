// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>

namespace rhmap {

/// Size and alignment of a large piece of memory: what one large page of most systems holds.
inline constexpr std::size_t kLargePieceBytes = std::size_t{1} << 21;

/// A piece straight from the system: a heap that is full of small holes, as programs with trees of pointers leave it,
/// has no part in it. Throws std::bad_alloc.
///
/// `as_large_page` asks for one large page. Then the whole of it is occupied with the first write; but it is there with
/// one fault instead of 512, and random access finds it without a walk through the page tables.
void* allocateLargePiece(bool as_large_page);
void freeLargePiece(void* piece) noexcept;

/// Makes a piece that is in use one large page, where the system can. Nothing in it changes.
void makeLargePage(void* piece) noexcept;

/// Any number of bytes in large pages, as many as hold them.
void* allocateLargePages(std::size_t bytes);
void freeLargePages(void* memory, std::size_t bytes) noexcept;

/// Memory for what is read at random and may be large, as a hash table: from one large page on, large pages.
template <class T>
struct LargePageAllocator {
  using value_type = T;

  LargePageAllocator() = default;
  template <class U>
  LargePageAllocator(const LargePageAllocator<U>&) noexcept {}

  T* allocate(std::size_t n) {
    return n < kLargePieceBytes / sizeof(T) ? std::allocator<T>().allocate(n)
                                            : static_cast<T*>(allocateLargePages(n * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t n) noexcept {
    if (n < kLargePieceBytes / sizeof(T))
      std::allocator<T>().deallocate(memory, n);
    else
      freeLargePages(memory, n * sizeof(T));
  }

  bool operator==(const LargePageAllocator&) const = default;
};

}  // namespace rhmap
