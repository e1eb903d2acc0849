// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/large_piece.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "rhmap/core/record_pool.hpp"

namespace rhmap {
namespace {

TEST(LargePiece, KeepsWhatIsInItWhenItBecomesALargePage) {
  auto* piece = static_cast<unsigned char*>(allocateLargePiece(false));
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(piece) % kLargePieceBytes, 0);
  for (std::size_t i = 0; i < kLargePieceBytes; i += 1000) piece[i] = static_cast<unsigned char>(i / 1000);
  makeLargePage(piece);
  for (std::size_t i = 0; i < kLargePieceBytes; ++i)
    ASSERT_EQ(piece[i], i % 1000 == 0 ? static_cast<unsigned char>(i / 1000) : 0) << i;
  freeLargePiece(piece);
}

TEST(LargePageAllocator, ServesVectorsOfAllSizes) {
  std::vector<std::uint32_t, LargePageAllocator<std::uint32_t>> numbers;
  for (std::size_t n : {std::size_t{1}, kLargePieceBytes / 4 - 1, kLargePieceBytes / 4, kLargePieceBytes / 4 + 1,
                        3 * kLargePieceBytes / 4 + 5, std::size_t{7}}) {
    numbers.resize(n);
    numbers.shrink_to_fit();
    std::iota(numbers.begin(), numbers.end(), 0U);
    const auto copy = numbers;
    EXPECT_EQ(copy, numbers);
    EXPECT_EQ(copy.back(), n - 1);
    if (n * sizeof(std::uint32_t) >= kLargePieceBytes) {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % kLargePieceBytes, 0) << n;
    }
  }
}

TEST(PiecePool, HandsOutAlignedPiecesOfZeros) {
  for (const bool many : {false, true}) {
    PiecePool pool(many);
    std::vector<unsigned char*> pieces;
    for (std::size_t i = 0; i < 5 * kLargePieceBytes / kPieceBytes; ++i) {
      pieces.push_back(static_cast<unsigned char*>(pool.allocate()));
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(pieces.back()) % kPieceBytes, 0);
      for (std::size_t at = 0; at < kPieceBytes; at += 500) ASSERT_EQ(pieces.back()[at], 0) << i;
      std::memset(pieces.back(), static_cast<int>(i + 1), kPieceBytes);
    }
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (const std::size_t at : {std::size_t{0}, kPieceBytes - 1}) ASSERT_EQ(pieces[i][at], i + 1);
  }
}

TEST(RecordPool, KeepsRecordsWhenTheirPiecesBecomeLargePages) {
  for (const bool many : {false, true}) {
    PiecePool pieces(many);
    RecordPool pool(pieces, {.bytes = 4096});
    std::vector<unsigned char*> records;
    for (std::size_t i = 0; i < 5 * kLargePieceBytes / 4096; ++i) {
      records.push_back(static_cast<unsigned char*>(pool.allocate()));
      std::memset(records.back(), static_cast<int>(i % 251), 4096);
    }
    EXPECT_EQ(pool.memoryUsage(), records.size() * 4096);
    for (std::size_t i = 0; i < records.size(); ++i)
      for (const std::size_t at : {0, 2000, 4095}) ASSERT_EQ(records[i][at], i % 251) << i;
  }
}

}  // namespace
}  // namespace rhmap
