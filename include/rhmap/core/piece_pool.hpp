// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "rhmap/core/large_piece.hpp"

namespace rhmap {

/// Size and alignment of the pieces of memory that maps are made of.
inline constexpr std::size_t kPieceBytes = std::size_t{1} << 18;

/// Where the pools of a map take their memory from, piece by piece. They share the large pages that it is cut from: the
/// rest of one of them is what the map does not use, and not a rest for each of its pools. For one thread at a time.
class PiecePool {
 public:
  /// `many` will be needed in any case; else a map that stays small takes little memory.
  explicit PiecePool(bool many = false) : many_(many) {}
  PiecePool(const PiecePool&) = delete;
  PiecePool& operator=(const PiecePool&) = delete;
  ~PiecePool() { clear(); }

  /// The next piece, all zero.
  void* allocate() {
    if (next_ == end_) addPage();
    return std::exchange(next_, next_ + kPieceBytes);
  }

  /// Frees all pieces.
  void clear() {
    for (void* page : pages_) freeLargePiece(page);
    pages_ = decltype(pages_)();
    next_ = end_ = nullptr;
  }

 private:
  static constexpr std::size_t kSmallPages = 3;  // so many become large ones together

  void addPage() {
    pages_.reserve(pages_.size() + 1);
    void* page = allocateLargePiece(many_ || pages_.size() >= kSmallPages);
    if (!many_ && pages_.size() == kSmallPages)
      for (void* small : pages_) makeLargePage(small);
    pages_.push_back(page);
    next_ = static_cast<char*>(page);
    end_ = next_ + kLargePieceBytes;
  }

  bool many_;
  std::vector<void*> pages_;
  char* next_ = nullptr;  // of the last page, up to
  char* end_ = nullptr;
};

}  // namespace rhmap
