// SPDX-License-Identifier: BSD-3-Clause
#include "visibility.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rhmap {

SensorView::SensorView(const KeySpace& keys, const octomap::pose6d& pose) {
  const double res = keys.resolution();
  const auto& q = pose.rot();
  const double u = q.u(), x = q.x(), y = q.y(), z = q.z();
  const double n = u * u + x * x + y * y + z * z;
  const double r[3][3] = {{u * u + x * x - y * y - z * z, 2 * (x * y - u * z), 2 * (x * z + u * y)},
                          {2 * (x * y + u * z), u * u - x * x + y * y - z * z, 2 * (y * z - u * x)},
                          {2 * (x * z - u * y), 2 * (y * z + u * x), u * u - x * x - y * y + z * z}};
  for (unsigned i = 0; i < 3; ++i) {
    origin_[i] = static_cast<float>(double(pose.trans()(i)) / res - 0.5 + double(kTreeMaxVal));
    for (unsigned j = 0; j < 3; ++j) rows_[i][j] = static_cast<float>(r[j][i] / n * res);
  }
}

Visibility::Visibility(const RangeImage& image, const ScanPoints& scan, const VisibilityConfig& config, double cube)
    : projection_(image.projection()), ranges_(image.ranges()), margin_(static_cast<float>(config.margin)), near_(static_cast<float>(config.near)), min_seen_(config.min_seen) {
  segment_ = float(config.segment * config.segment);
  points_.resize(ranges_.size());
  for (int i = 0; i < projection_.rows; ++i) for (int j = 0; j < projection_.columns; ++j) if (int k = image.pointAt(i, j); k >= 0) points_[i * projection_.columns + j] = {scan.x[k], scan.y[k], scan.z[k]};

  // A cube is as large as the ball around it.
  const double radius = cube * config.ball;
  const double rows = double(projection_.rowsPerRadian()), columns = projection_.columns / (2 * double(kPi));
  for (int step = 0; step < 40 * kStepsPerMetre; ++step) {
    const double angle = radius / std::max((step + 0.5) / double(kStepsPerMetre), 1.0);
    windows_.push_back({static_cast<std::int8_t>(std::max(config.window, static_cast<int>(std::ceil(angle * rows + config.extra)))),
                                     static_cast<std::int8_t>(std::max(config.window, static_cast<int>(std::ceil(angle * columns + config.extra))))});
  }
}

bool Visibility::isClear(int row, int column, float range, const std::array<float, 3>& p) const {
  const auto step = static_cast<std::size_t>(range * kStepsPerMetre);
  const Window window = step < windows_.size() ? windows_[step] : windows_.back();
  const float behind = range + margin_, before = range - near_;
  int seen = 0;
  const std::size_t at = static_cast<std::size_t>(row * projection_.columns + column);
  const bool empty = ranges_[at] == RangeImage::kEmpty;
  const auto& b = points_[at];
  for (int i = std::max(0, row - window.up); i <= std::min(projection_.rows - 1, row + window.up); ++i) {
    for (int c = column - window.beside; c <= column + window.beside; ++c) {
      const int j = c < 0 ? c + projection_.columns : c >= projection_.columns ? c - projection_.columns : c;
      const float r = ranges_[static_cast<std::size_t>(i * projection_.columns + j)];
      if (r <= behind) {
        if (r >= before || empty) return false;
        const auto& a = points_[static_cast<std::size_t>(i * projection_.columns + j)];
        float d[3], e[3], de = 0, dd = 0;
        for (int k = 0; k < 3; ++k) d[k] = b[k] - a[k], e[k] = p[k] - a[k], de += d[k] * e[k], dd += d[k] * d[k];
        const float t = std::clamp(de / dd, 0.0F, 1.0F);
        float q = 0;
        for (int k = 0; k < 3; ++k) q += (e[k] - t * d[k]) * (e[k] - t * d[k]);
        if (q < segment_) return false;
      }
      seen += r > behind && r < RangeImage::kEmpty;
    }
  }
  return seen >= min_seen_;
}

}  // namespace rhmap
