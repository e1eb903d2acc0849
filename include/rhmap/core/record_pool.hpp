// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "rhmap/core/piece_pool.hpp"

namespace rhmap {

/// What a RecordPool is for.
struct Records {
  std::size_t bytes;      ///< of each, those of a pointer or more; multiples of an alignment are aligned so
  std::size_t apart = 0;  ///< of what belongs to each but lies apart, so that the records are dense; see apartOf()
};

/// Memory for records of one size, at addresses that stay. Released records are kept for reuse.
class RecordPool {
 public:
  /// In pieces of a pool that outlives the records.
  RecordPool(PiecePool& pieces, const Records& records) : pieces_(&pieces), records_(records) {}
  RecordPool(const RecordPool&) = delete;
  RecordPool& operator=(const RecordPool&) = delete;

  void* allocate() {
    if (released_ != nullptr) {
      void* record = released_;
      std::memcpy(&released_, record, sizeof released_);
      return record;
    }
    if (next_ == end_) addPiece();
    void* record = next_;
    next_ += records_.bytes;
    return record;
  }

  void release(void* record) noexcept {
    std::memcpy(record, &released_, sizeof released_);
    released_ = record;
  }

  /// What lies apart of a record: in the order of the records, behind all of those in the same piece of memory. Inlined
  /// by force, for who only asks for its memory (see BlockIndex::prefetch).
  [[gnu::always_inline]] static void* apartOf(const void* record, std::size_t bytes, std::size_t apart) {
    const std::size_t offset = reinterpret_cast<std::uintptr_t>(record) % kPieceBytes;
    char* piece = static_cast<char*>(const_cast<void*>(record)) - offset;
    return piece + inPiece(bytes, apart) * bytes + offset / bytes * apart;
  }

  /// Forgets all records, whose memory is about to be freed.
  void clear() {
    released_ = nullptr;
    capacity_ = 0;
    next_ = end_ = nullptr;
  }

  std::size_t memoryUsage() const {
    return (capacity_ - static_cast<std::size_t>(end_ - next_) / records_.bytes) * (records_.bytes + records_.apart);
  }

 private:
  static constexpr std::size_t inPiece(std::size_t bytes, std::size_t apart) { return kPieceBytes / (bytes + apart); }

  void addPiece() {
    const std::size_t records = inPiece(records_.bytes, records_.apart);
    next_ = static_cast<char*>(pieces_->allocate());
    end_ = next_ + records * records_.bytes;
    capacity_ += records;
  }

  PiecePool* pieces_;
  Records records_;
  void* released_ = nullptr;  // the last of them; each holds the address of the one before
  std::size_t capacity_ = 0;  // records
  char* next_ = nullptr;      // of the last piece, up to
  char* end_ = nullptr;
};

}  // namespace rhmap
