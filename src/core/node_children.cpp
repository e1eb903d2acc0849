// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/node_children.hpp"

#include <array>
#include <atomic>
#include <bit>
#include <new>

namespace rhmap {
namespace {

// One bit for each place where a slab may be, in pieces that come into being where slabs are: 48 bits of address are 30
// bits of slab, 14 for the directory and 16 inside a piece of 8 kB.
constexpr int kSlabShift = std::countr_zero(kSlabBytes);
constexpr int kPieceBits = 16;
constexpr std::size_t kPieces = std::size_t{1} << (48 - kSlabShift - kPieceBits);

using Piece = std::array<std::atomic<std::uint64_t>, (std::size_t{1} << kPieceBits) / 64>;
constinit std::array<std::atomic<Piece*>, kPieces> directory{};

struct Place {
  std::size_t piece, word;
  std::uint64_t bit;

  explicit Place(const void* address) {
    const std::uintptr_t slab = reinterpret_cast<std::uintptr_t>(address) >> kSlabShift;
    piece = slab >> kPieceBits;
    word = slab % (std::size_t{1} << kPieceBits) / 64;
    bit = std::uint64_t{1} << slab % 64;
  }
};

Piece& pieceOf(std::size_t index) {
  Piece* piece = directory[index].load(std::memory_order_acquire);
  if (piece != nullptr) return *piece;
  auto* fresh = new Piece{};
  if (directory[index].compare_exchange_strong(piece, fresh, std::memory_order_acq_rel)) return *fresh;
  delete fresh;  // another thread was faster
  return *piece;
}

}  // namespace

void addSlab(const SlabHeader* slab) {
  const Place place(slab);
  if (place.piece >= kPieces) throw std::bad_alloc();  // no system hands out such addresses unless asked to
  pieceOf(place.piece)[place.word].fetch_or(place.bit, std::memory_order_relaxed);
}

void removeSlab(const SlabHeader* slab) {
  const Place place(slab);
  (*directory[place.piece].load(std::memory_order_acquire))[place.word].fetch_and(~place.bit,
                                                                                  std::memory_order_relaxed);
}

// Relaxed: whoever has a pointer to a node of another thread's map got it by some synchronisation.
bool isInSlab(const void* address) {
  const Place place(address);
  if (place.piece >= kPieces) return false;
  const Piece* piece = directory[place.piece].load(std::memory_order_acquire);
  return piece != nullptr && ((*piece)[place.word].load(std::memory_order_relaxed) & place.bit) != 0;
}

}  // namespace rhmap
