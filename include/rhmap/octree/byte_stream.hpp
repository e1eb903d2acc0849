// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <istream>
#include <memory>
#include <ostream>
#include <stdexcept>

/// Small pieces in and out of streams without a call of the stream for each.
namespace rhmap::codec {

/// Collects small pieces and hands them to the stream in large ones.
class ByteWriter {
 public:
  explicit ByteWriter(std::ostream& stream) : stream_(stream) {}
  ~ByteWriter() { flush(); }
  ByteWriter(const ByteWriter&) = delete;
  ByteWriter& operator=(const ByteWriter&) = delete;

  /// Room for up to `n` (at most kLargest) bytes; end() says how many there were.
  static constexpr std::size_t kLargest = 1 << 15;
  char* begin(std::size_t n) {
    if (n > kSize - used_) flush();
    return buffer_.get() + used_;
  }
  void end(const char* last) { used_ = static_cast<std::size_t>(last - buffer_.get()); }

  void put(std::uint8_t byte) {
    char* to = begin(1);
    *to = static_cast<char>(byte);
    end(to + 1);
  }

  /// The stream itself, for a piece that is written by others.
  std::ostream& stream() {
    flush();
    return stream_;
  }

 private:
  static constexpr std::size_t kSize = 1 << 16;

  void flush() {
    stream_.write(buffer_.get(), static_cast<std::streamsize>(used_));
    used_ = 0;
  }

  std::ostream& stream_;
  std::size_t used_ = 0;
  std::unique_ptr<char[]> buffer_ = std::make_unique_for_overwrite<char[]>(kSize);
};

/// Takes small pieces out of a stream, and not a byte more than was asked for: it reads ahead where the stream can be
/// set back, and gives back what is left when it is destroyed.
class ByteReader {
 public:
  explicit ByteReader(std::istream& stream)
      : stream_(stream), ahead_(stream.rdbuf()->pubseekoff(0, std::ios::cur, std::ios::in) != std::streampos(-1)) {}
  ~ByteReader() { giveBack(); }
  ByteReader(const ByteReader&) = delete;
  ByteReader& operator=(const ByteReader&) = delete;

  /// The next `n` (not many) bytes, until the next call; throws where the stream ends before.
  const char* take(std::size_t n) {
    if (n > end_ - at_) refill(n);
    const char* bytes = buffer_.get() + at_;
    at_ += n;
    return bytes;
  }

  /// The stream itself, for a piece that is read by others.
  std::istream& stream() {
    giveBack();
    return stream_;
  }

 private:
  static constexpr std::size_t kSize = 1 << 16;

  void refill(std::size_t n) {
    std::memmove(buffer_.get(), buffer_.get() + at_, end_ - at_);
    end_ -= at_;
    at_ = 0;
    const std::size_t wanted = (ahead_ ? kSize : n) - end_;
    end_ += static_cast<std::size_t>(std::max<std::streamsize>(
        stream_.rdbuf()->sgetn(buffer_.get() + end_, static_cast<std::streamsize>(wanted)), 0));
    if (end_ < n) throw std::runtime_error("the data ends in the middle of the tree");
  }

  void giveBack() {
    if (end_ != at_) stream_.rdbuf()->pubseekoff(-static_cast<std::streamoff>(end_ - at_), std::ios::cur, std::ios::in);
    at_ = end_ = 0;
  }

  std::istream& stream_;
  bool ahead_;
  std::size_t at_ = 0;
  std::size_t end_ = 0;
  std::unique_ptr<char[]> buffer_ = std::make_unique_for_overwrite<char[]>(kSize);
};

}  // namespace rhmap::codec
