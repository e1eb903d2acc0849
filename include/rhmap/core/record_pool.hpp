// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

#include "rhmap/core/large_piece.hpp"

namespace rhmap {

/// Memory for records of one size, at addresses that stay. Released records are kept for reuse.
class RecordPool {
 public:
  /// `bytes`: of a record, that of a pointer or more. Multiples of an alignment (up to kLargePieceBytes) are aligned
  /// so.
  explicit RecordPool(std::size_t bytes) : bytes_(bytes) {}
  RecordPool(const RecordPool&) = delete;
  RecordPool& operator=(const RecordPool&) = delete;
  ~RecordPool() { clear(); }

  void* allocate() {
    if (released_ != nullptr) {
      void* record = released_;
      std::memcpy(&released_, record, sizeof released_);
      return record;
    }
    if (next_ == end_) addPiece();
    void* record = next_;
    next_ += bytes_;
    return record;
  }

  void release(void* record) noexcept {
    std::memcpy(record, &released_, sizeof released_);
    released_ = record;
  }

  void clear() {
    for (void* piece : pieces_) freeLargePiece(piece);
    pieces_ = decltype(pieces_)();
    released_ = nullptr;
    capacity_ = 0;
    next_ = end_ = nullptr;
  }

  std::size_t memoryUsage() const { return capacity_ * bytes_ - static_cast<std::size_t>(end_ - next_); }

 private:
  void addPiece() {
    const std::size_t records = kLargePieceBytes / bytes_;
    pieces_.reserve(pieces_.size() + 1);
    void* piece = allocateLargePiece(!pieces_.empty());  // small maps stay small
    pieces_.push_back(piece);
    capacity_ += records;
    next_ = static_cast<char*>(piece);
    end_ = next_ + records * bytes_;
  }

  std::size_t bytes_;
  std::vector<void*> pieces_;
  void* released_ = nullptr;  // the last of them; each holds the address of the one before
  std::size_t capacity_ = 0;  // records
  char* next_ = nullptr;      // of the last piece, up to
  char* end_ = nullptr;
};

}  // namespace rhmap
