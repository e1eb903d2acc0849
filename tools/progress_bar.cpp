// SPDX-License-Identifier: BSD-3-Clause
#include "progress_bar.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace rhmap::tools {
namespace {

constexpr std::size_t kWidth = 40;
constexpr const char* kClearLine = "\r\x1b[K";

}  // namespace

ProgressBar::ProgressBar(std::string label, std::size_t total)
    : label_(std::move(label)), total_(total), visible_(isatty(STDERR_FILENO) != 0) {
  if (visible_) draw();
}

ProgressBar::~ProgressBar() {
  if (visible_) std::fputs(kClearLine, stderr);
}

void ProgressBar::advance() {
  ++done_;
  if (visible_) draw();
}

void ProgressBar::draw() const {
  const std::size_t filled = total_ == 0 ? kWidth : kWidth * done_ / total_;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const auto rest = done_ == 0 ? std::string()
                               : fmt::format("  {:.0f} s left", std::ceil(elapsed / static_cast<double>(done_) *
                                                                          static_cast<double>(total_ - done_)));
  fmt::print(stderr, "{}{} [{:#<{}}{:.<{}}] {}/{}{}", kClearLine, label_, "", filled, "", kWidth - filled, done_,
             total_, rest);
  std::fflush(stderr);
}

}  // namespace rhmap::tools
