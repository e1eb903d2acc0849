// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/node_children.hpp"

#include <array>
#include <atomic>
#include <bit>
#include <new>

namespace rhmap {
namespace {

// One bit for each place where a slab may be, in parts that come into being where slabs are: 48 bits of address are 30
// bits of slab, 14 for the directory and 16 inside a part of 8 kB.
constexpr int kSlabShift = std::countr_zero(kSlabBytes);
constexpr int kPartBits = 16;
constexpr std::size_t kParts = std::size_t{1} << (48 - kSlabShift - kPartBits);

using Part = std::array<std::atomic<std::uint64_t>, (std::size_t{1} << kPartBits) / 64>;
constinit std::array<std::atomic<Part*>, kParts> directory{};

struct Place {
  std::size_t part, word;
  std::uint64_t bit;

  explicit Place(const void* address) {
    const std::uintptr_t slab = reinterpret_cast<std::uintptr_t>(address) >> kSlabShift;
    part = slab >> kPartBits;
    word = slab % (std::size_t{1} << kPartBits) / 64;
    bit = std::uint64_t{1} << slab % 64;
  }
};

Part& partOf(std::size_t index) {
  Part* part = directory[index].load(std::memory_order_acquire);
  if (part != nullptr) return *part;
  auto* fresh = new Part{};
  if (directory[index].compare_exchange_strong(part, fresh, std::memory_order_acq_rel)) return *fresh;
  delete fresh;  // another thread was faster
  return *part;
}

}  // namespace

void addSlab(const SlabHeader* slab) {
  const Place place(slab);
  if (place.part >= kParts) throw std::bad_alloc();  // no system hands out such addresses unless asked to
  partOf(place.part)[place.word].fetch_or(place.bit, std::memory_order_relaxed);
}

void removeSlab(const SlabHeader* slab) {
  const Place place(slab);
  (*directory[place.part].load(std::memory_order_acquire))[place.word].fetch_and(~place.bit, std::memory_order_relaxed);
}

// Relaxed: whoever has a pointer to a node of another thread's map got it by some synchronisation.
bool isInSlab(const void* address) {
  const Place place(address);
  if (place.part >= kParts) return false;
  const Part* part = directory[place.part].load(std::memory_order_acquire);
  return part != nullptr && ((*part)[place.word].load(std::memory_order_relaxed) & place.bit) != 0;
}

}  // namespace rhmap
