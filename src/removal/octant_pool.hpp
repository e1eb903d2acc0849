// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <vector>

#include "octant.hpp"
#include "rhmap/core/large_piece.hpp"

namespace rhmap {

/// Memory for octants at addresses that stay. The masks lie side by side in the lower part of each piece of memory, so
/// that neighbours share pages; the histories lie in the upper part, and the address of the masks tells where.
class OctantPool {
 public:
  OctantPool() = default;
  OctantPool(const OctantPool&) = delete;
  OctantPool& operator=(const OctantPool&) = delete;
  ~OctantPool() {
    for (std::byte* piece : pieces_) freeLargePiece(piece);
  }

  /// Of nothing that is known yet.
  Octant* allocate() {
    void* memory = released_;
    if (memory != nullptr) {
      std::memcpy(&released_, memory, sizeof released_);
    } else {
      if (next_ == kInPiece) addPiece();
      memory = pieces_.back() + next_++ * sizeof(Octant);
    }
    auto* octant = new (memory) Octant();
    new (static_cast<void*>(historyAt(octant))) OctantHistory();
    return octant;
  }

  void release(Octant* octant) noexcept {
    std::memcpy(static_cast<void*>(octant), &released_, sizeof released_);
    released_ = octant;
  }

  /// The history of an octant that was allocated.
  [[gnu::always_inline]] static OctantHistory* historyAt(const Octant* octant) {
    const std::size_t offset = reinterpret_cast<std::uintptr_t>(octant) % kLargePieceBytes;
    std::byte* piece = reinterpret_cast<std::byte*>(const_cast<Octant*>(octant)) - offset;
    return reinterpret_cast<OctantHistory*>(piece + kInPiece * sizeof(Octant) +
                                            offset / sizeof(Octant) * sizeof(OctantHistory));
  }

  std::size_t memoryUsage() const {
    return (pieces_.size() * kInPiece - (kInPiece - next_)) * (sizeof(Octant) + sizeof(OctantHistory));
  }

 private:
  static_assert(std::is_trivially_destructible_v<Octant> && std::is_trivially_destructible_v<OctantHistory>);
  static constexpr std::size_t kInPiece = kLargePieceBytes / (sizeof(Octant) + sizeof(OctantHistory));

  void addPiece() {
    pieces_.reserve(pieces_.size() + 1);
    pieces_.push_back(static_cast<std::byte*>(allocateLargePiece(!pieces_.empty())));  // small maps stay small
    next_ = 0;
  }

  std::vector<std::byte*> pieces_;
  std::size_t next_ = kInPiece;  // of the last piece
  void* released_ = nullptr;     // the last of them; each holds the address of the one before
};

/// Of an octant of a RegionMap. Inlined by force: who asks for its memory ahead does nothing else (see
/// BlockIndex::prefetch).
[[gnu::always_inline]] inline OctantHistory& historyOf(Octant& octant) { return *OctantPool::historyAt(&octant); }
[[gnu::always_inline]] inline const OctantHistory& historyOf(const Octant& octant) {
  return *OctantPool::historyAt(&octant);
}

}  // namespace rhmap
