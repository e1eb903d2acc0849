// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "rhmap/io/scan_sequence.hpp"

namespace rhmap::io {

std::unique_ptr<ScanSequence> openKitti(const std::filesystem::path& folder);
std::unique_ptr<ScanSequence> openGraph(const std::filesystem::path& file);
std::unique_ptr<ScanSequence> openLog(const std::filesystem::path& file);
std::unique_ptr<ScanSequence> openPointFile(const std::filesystem::path& file);

/// Throws std::out_of_range unless i < size.
inline void checkIndex(const std::filesystem::path& file, std::size_t i, std::size_t size) {
  if (i >= size) {
    throw std::out_of_range(file.string() + ": scan " + std::to_string(i) + " of " + std::to_string(size) +
                            " (counted from 0)");
  }
}

}  // namespace rhmap::io
