// SPDX-License-Identifier: BSD-3-Clause
#include "keyframes.hpp"

#include <algorithm>
#include <cmath>

namespace rhmap {
namespace {

double distance(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return std::hypot(double(a[0] - b[0]), double(a[1] - b[1]), double(a[2] - b[2]));
}

}  // namespace

double informationContent(const RangeImage& image, double r_max) {
  const Projection& p = image.projection();
  std::vector<float> farthest(static_cast<std::size_t>(p.columns), 0.0F);
  for (int i = 0; i < p.rows; ++i) {
    for (int j = 0; j < p.columns; ++j) {
      const float range = image.at(i, j);
      float& f = farthest[static_cast<std::size_t>(j)];
      if (range < RangeImage::kEmpty && range > f) f = range;
    }
  }
  double sum = 0;
  for (const float f : farthest) sum += std::min(double(f), r_max);
  return 100 * sum / (r_max * p.columns);
}

bool Keyframes::wants(const std::array<float, 3>& position, std::uint32_t scan, double information) {
  const bool wanted = !last_ || distance(position, last_->position) >= config_.distance ||
                      scan - last_->scan >= static_cast<std::uint32_t>(config_.scans) ||
                      std::fabs(information - last_->information) >= config_.information;
  if (wanted) last_ = Last{position, scan, information};
  return wanted;
}

std::optional<ScanContext> Keyframes::pop(const std::array<float, 3>& position) {
  if (waiting_.empty()) return std::nullopt;
  if (distance(position, waiting_.front().position) < config_.delay &&
      waiting_.size() <= static_cast<std::size_t>(config_.max_queue))
    return std::nullopt;
  return pop();
}

std::optional<ScanContext> Keyframes::pop() {
  if (waiting_.empty()) return std::nullopt;
  std::optional<ScanContext> context(std::move(waiting_.front().context));
  waiting_.pop_front();
  return context;
}

}  // namespace rhmap
