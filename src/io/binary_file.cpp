// SPDX-License-Identifier: BSD-3-Clause
#include "binary_file.hpp"

#include <system_error>

#include "rhmap/core/failure.hpp"

namespace rhmap::io {

BinaryFile::BinaryFile(const std::filesystem::path& file) : path_(file), stream_(file, std::ios::binary) {
  std::error_code error;
  size_ = std::filesystem::file_size(file, error);
  if (error) failOnFile(file, "cannot be read: " + error.message());
  if (!stream_) failOnFile(file, "cannot be opened");
}

void BinaryFile::require(std::uint64_t count, std::uint64_t bytes, const std::string& what) const {
  if (count > remaining() / bytes) {
    failOnFile(path_, "byte " + std::to_string(position_) + ": " + std::to_string(count) + " x " + what + " of " +
                          std::to_string(bytes) + " bytes wanted, but only " + std::to_string(remaining()) +
                          " bytes are left");
  }
}

void BinaryFile::skip(std::uint64_t count, std::uint64_t bytes, const std::string& what) {
  require(count, bytes, what);
  seek(position_ + count * bytes);
}

void BinaryFile::seek(std::uint64_t position) {
  stream_.seekg(static_cast<std::streamoff>(position));
  if (!stream_ || position > size_) failOnFile(path_, "byte " + std::to_string(position) + ": cannot be reached");
  position_ = position;
}

void BinaryFile::readBytes(char* to, std::uint64_t bytes) {
  if (!stream_.read(to, static_cast<std::streamsize>(bytes))) {
    failOnFile(path_, "byte " + std::to_string(position_) + ": cannot read " + std::to_string(bytes) + " bytes");
  }
  position_ += bytes;
}

}  // namespace rhmap::io
