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

Visibility::Visibility(const RangeImage& image, const VisibilityConfig& config, double cube)
    : projection_(image.projection()), margin_(static_cast<float>(config.margin)) {
  // A cube is as large as the ball around it.
  const double radius = cube * config.ball;
  const double rows = double(projection_.rowsPerRadian()), columns = projection_.columns / (2 * double(kPi));
  std::pair<int, int> last{-1, -1};
  for (int step = 0; step < 40 * kStepsPerMetre; ++step) {
    const double angle = radius / std::max((step + 0.5) / double(kStepsPerMetre), 1.0);
    const std::pair<int, int> window{std::max(config.window, static_cast<int>(std::ceil(angle * rows + config.extra))),
                                     std::max(config.window, static_cast<int>(std::ceil(angle * columns + config.extra)))};
    if (window != last) windows_.push_back(image.nearestAround(window.first, window.second));
    last = window;
    windowOf_.push_back(static_cast<std::uint8_t>(windows_.size() - 1));
  }
}

}  // namespace rhmap
