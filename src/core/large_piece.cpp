// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/large_piece.hpp"

#include <cstdint>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace rhmap {

#ifdef __linux__

void* allocateLargePiece(bool as_large_page) {
  // Twice as much, of which the aligned part is kept.
  void* memory = mmap(nullptr, 2 * kLargePieceBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  auto* first = static_cast<char*>(memory);
  const std::size_t before = -reinterpret_cast<std::uintptr_t>(first) % kLargePieceBytes;
  char* piece = first + before;
  if (before > 0) munmap(first, before);
  munmap(piece + kLargePieceBytes, kLargePieceBytes - before);
#ifdef MADV_HUGEPAGE
  if (as_large_page) madvise(piece, kLargePieceBytes, MADV_HUGEPAGE);  // advice: a system may not take it
#endif
  return piece;
}

void freeLargePiece(void* piece) noexcept { munmap(piece, kLargePieceBytes); }

#else

void* allocateLargePiece(bool /*as_large_page*/) {
  return ::operator new (kLargePieceBytes, std::align_val_t{kLargePieceBytes});
}

void freeLargePiece(void* piece) noexcept { ::operator delete (piece, std::align_val_t{kLargePieceBytes}); }

#endif

}  // namespace rhmap
