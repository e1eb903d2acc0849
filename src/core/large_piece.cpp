// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/large_piece.hpp"

#include <cstdint>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace rhmap {

#ifdef __linux__

namespace {

constexpr std::size_t inPieces(std::size_t bytes) {
  return (bytes + kLargePieceBytes - 1) / kLargePieceBytes * kLargePieceBytes;
}

/// A multiple of pieces, aligned as they are: one piece more, of which the aligned part is kept.
char* map(std::size_t bytes) {
  void* memory = mmap(nullptr, bytes + kLargePieceBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  auto* first = static_cast<char*>(memory);
  const std::size_t before = -reinterpret_cast<std::uintptr_t>(first) % kLargePieceBytes;
  char* aligned = first + before;
  if (before > 0) munmap(first, before);
  munmap(aligned + bytes, kLargePieceBytes - before);
  return aligned;
}

/// Advice: a system may not take it.
void askForLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  madvise(memory, bytes, MADV_HUGEPAGE);
#endif
}

}  // namespace

void* allocateLargePiece(bool as_large_page) {
  char* piece = map(kLargePieceBytes);
  if (as_large_page) askForLargePages(piece, kLargePieceBytes);
  return piece;
}

void freeLargePiece(void* piece) noexcept { munmap(piece, kLargePieceBytes); }

void makeLargePage(void* piece) noexcept {
  askForLargePages(piece, kLargePieceBytes);
#ifdef MADV_COLLAPSE
  madvise(piece, kLargePieceBytes, MADV_COLLAPSE);  // at once; without it, when the system finds the time
#endif
}

void* allocateLargePages(std::size_t bytes) {
  char* memory = map(inPieces(bytes));
  askForLargePages(memory, inPieces(bytes));
  return memory;
}

void freeLargePages(void* memory, std::size_t bytes) noexcept { munmap(memory, inPieces(bytes)); }

#else

void* allocateLargePiece(bool /*as_large_page*/) {
  return ::operator new (kLargePieceBytes, std::align_val_t{kLargePieceBytes});
}

void freeLargePiece(void* piece) noexcept { ::operator delete (piece, std::align_val_t{kLargePieceBytes}); }

void makeLargePage(void* /*piece*/) noexcept {}

void* allocateLargePages(std::size_t bytes) { return ::operator new (bytes, std::align_val_t{kLargePieceBytes}); }

void freeLargePages(void* memory, std::size_t /*bytes*/) noexcept {
  ::operator delete (memory, std::align_val_t{kLargePieceBytes});
}

#endif

}  // namespace rhmap
