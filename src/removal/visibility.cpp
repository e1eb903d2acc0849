// SPDX-License-Identifier: BSD-3-Clause
#include "visibility.hpp"

#include <cmath>

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

}  // namespace rhmap
