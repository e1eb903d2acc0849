// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "rhmap/core/block.hpp"
#include "rhmap/core/large_piece.hpp"

namespace rhmap {

/// Memory for blocks, at addresses that stay. Released blocks are kept for reuse.
class BlockPool {
 public:
  BlockPool() = default;
  BlockPool(const BlockPool&) = delete;
  BlockPool& operator=(const BlockPool&) = delete;
  ~BlockPool() { clear(); }

  Block* allocate() {
    if (!free_.empty()) {
      Block* block = free_.back();
      free_.pop_back();
      return block;
    }
    if (next_ == end_) addChunk();
    return next_++;
  }

  void release(Block* block) noexcept { free_.push_back(block); }

  void clear() {
    for (void* chunk : chunks_) freeLargePiece(chunk);
    chunks_ = decltype(chunks_)();
    free_ = decltype(free_)();
    capacity_ = 0;
    next_ = end_ = nullptr;
  }

  std::size_t memoryUsage() const {
    return (capacity_ - static_cast<std::size_t>(end_ - next_)) * sizeof(Block) + free_.size() * sizeof(Block*);
  }

 private:
  static constexpr std::size_t kChunk = kLargePieceBytes / sizeof(Block);

  void addChunk() {
    chunks_.reserve(chunks_.size() + 1);
    free_.reserve(capacity_ + kChunk);                    // so that release() cannot throw
    void* memory = allocateLargePiece(!chunks_.empty());  // small maps stay small
    chunks_.push_back(memory);
    capacity_ += kChunk;
    next_ = static_cast<Block*>(memory);
    end_ = next_ + kChunk;
  }

  std::vector<void*> chunks_;
  std::vector<Block*> free_;
  std::size_t capacity_ = 0;
  Block* next_ = nullptr;  // of the last chunk, up to
  Block* end_ = nullptr;
};

}  // namespace rhmap
