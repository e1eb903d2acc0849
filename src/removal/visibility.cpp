// SPDX-License-Identifier: BSD-3-Clause
#include "visibility.hpp"

#include <algorithm>

namespace rhmap {
namespace {

constexpr double kFarthestStep = 40;  // [m]; a cube beyond needs no window of its own

float squaredDistanceToSegment(const std::array<float, 3>& p, const std::array<float, 3>& a,
                               const std::array<float, 3>& b) {
  std::array<float, 3> d, e;
  float de = 0, dd = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    d[k] = b[k] - a[k], e[k] = p[k] - a[k];
    de += d[k] * e[k], dd += d[k] * d[k];
  }
  const float t = dd > 0 ? std::clamp(de / dd, 0.0F, 1.0F) : 0.0F;
  float squared = 0;
  for (std::size_t k = 0; k < 3; ++k) squared += (e[k] - t * d[k]) * (e[k] - t * d[k]);
  return squared;
}

}  // namespace

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
    : projection_(image.projection()),
      ranges_(image.ranges()),
      points_(ranges_.size()),
      behind_(static_cast<float>(config.behind)),
      before_(static_cast<float>(config.before)),
      surface_(static_cast<float>(config.surface)),
      surface_share_(static_cast<float>(config.surface_share)) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (const std::int32_t k = image.points()[i]; k >= 0) {
      const auto at = static_cast<std::size_t>(k);
      points_[i] = {scan.x[at], scan.y[at], scan.z[at]};
    }
  }

  // A cube is as large as the ball around it.
  const double radius = cube * std::sqrt(3.0) / 2;
  const double rows = double(projection_.rowsPerRadian()), columns = projection_.columns / (2 * double(kPi));
  const auto pixels = [&](double count) {
    return static_cast<std::int8_t>(std::clamp(static_cast<int>(std::ceil(count)), config.window, 64));
  };
  for (int step = 0; step < kFarthestStep * double(kStepsPerMetre); ++step) {
    const double angle = radius / std::max((step + 0.5) / double(kStepsPerMetre), 1.0);
    windows_.push_back({pixels(angle * rows), pixels(angle * columns)});
  }

  // The farthest of a block, then of the blocks around.
  const int block_rows = (projection_.rows + kBlock - 1) / kBlock;
  block_columns_ = (projection_.columns + kBlock - 1) / kBlock;
  std::vector<float> own(static_cast<std::size_t>(block_rows * block_columns_), 0.0F);
  for (int i = 0; i < projection_.rows; ++i) {
    for (int j = 0; j < projection_.columns; ++j) {
      const float range = ranges_[static_cast<std::size_t>(i * projection_.columns + j)];
      float& farthest = own[static_cast<std::size_t>(i / kBlock * block_columns_ + j / kBlock)];
      farthest = range < RangeImage::kEmpty && range > farthest ? range : farthest;
    }
  }
  farthest_ = own;
  for (int i = 0; i < block_rows; ++i) {
    for (int j = 0; j < block_columns_; ++j) {
      float& farthest = farthest_[static_cast<std::size_t>(i * block_columns_ + j)];
      for (int di = -1; di <= 1; ++di) {
        for (int dj = -1; dj <= 1; ++dj) {
          if (i + di < 0 || i + di >= block_rows) continue;
          const int beside = (j + dj + block_columns_) % block_columns_;
          farthest = std::max(farthest, own[static_cast<std::size_t>((i + di) * block_columns_ + beside)]);
        }
      }
    }
  }
}

bool Visibility::hides(const std::array<float, 3>& p, float radius) const {
  const float range = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  // The blocks around reach at least a block's width to all sides: too little for what is near.
  const float level = std::max(std::sqrt(p[0] * p[0] + p[1] * p[1]), 1e-3F);
  const float reach = 1.1F * radius / level *
                      std::max(projection_.rowsPerRadian(), static_cast<float>(projection_.columns) / (2 * kPi));
  if (reach + 1 > kBlock) return false;
  const float row = std::clamp(projection_.rowOf(p[0], p[1], p[2]), 0.0F, static_cast<float>(projection_.rows - 1));
  const int block = static_cast<int>(row) / kBlock * block_columns_ + projection_.columnOf(p[0], p[1]) / kBlock;
  return farthest_[static_cast<std::size_t>(block)] <= range - radius + behind_;
}

Look Visibility::around(const std::array<float, 3>& p, float range, int row, int column) const {
  const auto step = static_cast<std::size_t>(range * kStepsPerMetre);
  const Window window = step < windows_.size() ? windows_[step] : windows_.back();
  const float behind = range + behind_, before = range - before_;
  const float surface = std::max(surface_, surface_share_ * range);
  const auto centre = static_cast<std::size_t>(row * projection_.columns + column);
  const bool empty = ranges_[centre] == RangeImage::kEmpty;
  bool seen = false, clear = true;
  for (int i = std::max(0, row - window.up); i <= std::min(projection_.rows - 1, row + window.up); ++i) {
    for (int c = column - window.beside; c <= column + window.beside; ++c) {
      const int j = c < 0 ? c + projection_.columns : c >= projection_.columns ? c - projection_.columns : c;
      const auto at = static_cast<std::size_t>(i * projection_.columns + j);
      const float other = ranges_[at];
      if (other > behind) {
        seen = seen || other < RangeImage::kEmpty;
        continue;
      }
      if (other >= before) return Look::kFilled;
      // Something nearer beside the cube: a surface may run from there to what is seen at the cube's own pixel.
      clear = clear && !empty && squaredDistanceToSegment(p, points_[at], points_[centre]) >= surface * surface;
    }
  }
  return seen && clear ? Look::kSeenThrough : Look::kUnknown;
}

}  // namespace rhmap
