// SPDX-License-Identifier: BSD-3-Clause
#include "scan_points.hpp"

#include <cmath>

namespace rhmap {
namespace {

/// octomap::Pose6D::transform, written out: q * p * q^-1 + t in floats, in octomath's order of operations.
class Transform {
 public:
  explicit Transform(const octomap::pose6d& pose)
      : u_(pose.rot().u()), x_(pose.rot().x()), y_(pose.rot().y()), z_(pose.rot().z()) {
    const octomath::Quaternion inverse = pose.rot().inv();
    iu_ = inverse.u(), ix_ = inverse.x(), iy_ = inverse.y(), iz_ = inverse.z();
    for (unsigned i = 0; i < 3; ++i) t_[i] = pose.trans()(i);
  }

  void operator()(float px, float py, float pz, float& wx, float& wy, float& wz) const {
    const float au = -x_ * px - y_ * py - z_ * pz;
    const float ax = y_ * pz - py * z_ + u_ * px;
    const float ay = z_ * px - pz * x_ + u_ * py;
    const float az = x_ * py - px * y_ + u_ * pz;
    wx = (ay * iz_ - iy_ * az + au * ix_ + iu_ * ax) + t_[0];
    wy = (az * ix_ - iz_ * ax + au * iy_ + iu_ * ay) + t_[1];
    wz = (ax * iy_ - ix_ * ay + au * iz_ + iu_ * az) + t_[2];
  }

 private:
  float u_, x_, y_, z_, iu_, ix_, iy_, iz_;
  float t_[3];
};

}  // namespace

void locatePoints(const KeySpace& keys, const octomap::Pointcloud& points, const octomap::pose6d& pose,
                  double min_range, double max_range, ScanPoints& scan) {
  const std::size_t n = points.size();
  for (std::vector<float>* v : {&scan.x, &scan.y, &scan.z, &scan.range}) v->resize(n);
  scan.cube.resize(n);
  const Transform transform(pose);
  const auto nearest = static_cast<float>(min_range);
  const float farthest = max_range < 0 ? std::numeric_limits<float>::max() : static_cast<float>(max_range);
  std::size_t k = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const octomap::point3d& p = points[static_cast<unsigned>(i)];
    const float range = std::sqrt(p.x() * p.x() + p.y() * p.y() + p.z() * p.z());
    if (!(range >= nearest && range <= farthest)) continue;  // NaN and infinity, too
    float wx, wy, wz;
    transform(p.x(), p.y(), p.z(), wx, wy, wz);
    if (!keys.coordToKeyChecked(wx, wy, wz, scan.cube[k])) continue;
    scan.x[k] = p.x(), scan.y[k] = p.y(), scan.z[k] = p.z(), scan.range[k] = range;
    ++k;
  }
  for (std::vector<float>* v : {&scan.x, &scan.y, &scan.z, &scan.range}) v->resize(k);
  scan.cube.resize(k);
  scan.given = n;
  scan.dropped = n - k;
}

}  // namespace rhmap
