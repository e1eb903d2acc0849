// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <type_traits>
#include <vector>

namespace rhmap::io {

static_assert(std::endian::native == std::endian::little, "the binary formats are little-endian and read as they are");

/// Reads values one after the other and never believes a count: nothing is allocated or read past the file's end.
class BinaryFile {
 public:
  explicit BinaryFile(const std::filesystem::path& file);

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  std::uint64_t position() const { return position_; }
  std::uint64_t remaining() const { return size_ - position_; }

  /// Throws unless `count` items of `bytes` each are still to come; `what` names them in the message.
  void require(std::uint64_t count, std::uint64_t bytes, const std::string& what) const;

  /// Passes over `count` items of `bytes` each.
  void skip(std::uint64_t count, std::uint64_t bytes, const std::string& what);

  /// Goes to a byte position within the file.
  void seek(std::uint64_t position);

  template <typename T>
  std::vector<T> readArray(std::uint64_t count, const std::string& what) {
    static_assert(std::is_trivially_copyable_v<T>);
    require(count, sizeof(T), what);
    std::vector<T> values(static_cast<std::size_t>(count));
    readBytes(reinterpret_cast<char*>(values.data()), count * sizeof(T));
    return values;
  }

  template <typename T>
  T read(const std::string& what) {
    static_assert(std::is_trivially_copyable_v<T>);
    require(1, sizeof(T), what);
    T value;
    readBytes(reinterpret_cast<char*>(&value), sizeof(T));
    return value;
  }

 private:
  void readBytes(char* to, std::uint64_t bytes);

  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;
};

}  // namespace rhmap::io
