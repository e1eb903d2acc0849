// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "formats.hpp"

namespace rhmap::io {

/// The scans of a text file, which have to be parsed to be found: all held in memory, 12 bytes a point.
class MemorySequence : public ScanSequence {
 public:
  struct NamedScan {
    std::string name;
    Scan scan;
  };

  MemorySequence(const std::filesystem::path& file, std::vector<NamedScan> scans)
      : file_(file), scans_(std::move(scans)) {}

  std::size_t size() const override { return scans_.size(); }

  Scan scan(std::size_t i) const override { return at(i).scan; }

  std::string name(std::size_t i) const override { return at(i).name; }

 private:
  const NamedScan& at(std::size_t i) const {
    checkIndex(file_, i, scans_.size());
    return scans_[i];
  }

  std::filesystem::path file_;
  std::vector<NamedScan> scans_;
};

}  // namespace rhmap::io
