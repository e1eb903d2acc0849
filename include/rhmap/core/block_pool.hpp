// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "rhmap/core/block.hpp"

namespace rhmap {

/// Memory for blocks, at addresses that stay. Released blocks are kept for reuse.
class BlockPool {
 public:
  Block* allocate() {
    if (!free_.empty()) {
      Block* block = free_.back();
      free_.pop_back();
      return block;
    }
    if (chunks_.empty() || used_ == kChunk) {
      chunks_.push_back(std::make_unique_for_overwrite<Block[]>(kChunk));
      free_.reserve(chunks_.size() * kChunk);  // so that release() cannot throw
      used_ = 0;
    }
    return &chunks_.back()[used_++];
  }

  void release(Block* block) noexcept { free_.push_back(block); }

  void clear() {
    chunks_ = decltype(chunks_)();
    free_ = decltype(free_)();
    used_ = 0;
  }

  std::size_t memoryUsage() const { return chunks_.size() * kChunk * sizeof(Block) + free_.size() * sizeof(Block*); }

 private:
  static constexpr std::size_t kChunk = 64;
  std::vector<std::unique_ptr<Block[]>> chunks_;
  std::vector<Block*> free_;
  std::size_t used_ = 0;  // of the last chunk
};

}  // namespace rhmap
