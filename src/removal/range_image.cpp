// SPDX-License-Identifier: BSD-3-Clause
#include "range_image.hpp"

#include <algorithm>

#include "pixels.hpp"

namespace rhmap {
namespace {

constexpr int kSectors = 1800;        // 0.2 degrees: about what one shot of all beams covers
constexpr float kSameBeam = 0.0012F;  // [rad]; two points of a sector that are nearer in elevation are of one beam
constexpr float kDegree = kPi / 180;

/// The median step in elevation between neighbouring beams [rad]; 0 if there are too few points to tell.
float beamPitch(const ScanPoints& scan, const std::vector<float>& elevation) {
  std::vector<std::vector<float>> sectors(kSectors);
  for (std::size_t k = 0; k < scan.size(); ++k) {
    const float turn = fastAtan2(scan.y[k], scan.x[k]) * (0.5F / kPi) + 0.5F;
    sectors[static_cast<std::size_t>(turn * kSectors) % kSectors].push_back(elevation[k]);
  }
  std::vector<float> steps;
  for (auto& sector : sectors) {
    std::sort(sector.begin(), sector.end());
    for (std::size_t i = 1; i < sector.size(); ++i)
      if (const float step = sector[i] - sector[i - 1]; step > kSameBeam) steps.push_back(step);
  }
  if (steps.size() < 32) return 0;
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  return steps[steps.size() / 2];
}

}  // namespace

Projection measureProjection(const RangeImageConfig& config, const ScanPoints& scan) {
  Projection projection{.rows = config.rows,
                        .columns = config.columns,
                        .top = static_cast<float>(config.fov_up) * kDegree,
                        .bottom = static_cast<float>(config.fov_down) * kDegree};
  if (config.fov_up > config.fov_down && config.rows > 0) return projection;

  std::vector<float> elevation(scan.size());
  for (std::size_t k = 0; k < scan.size(); ++k)
    elevation[k] = fastAtan2(scan.z[k], std::sqrt(scan.x[k] * scan.x[k] + scan.y[k] * scan.y[k]));
  if (!(config.fov_up > config.fov_down)) {
    // A few stray points must not stretch the image.
    std::vector<float> sorted = elevation;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t stray = sorted.size() / 2000;
    projection.bottom = sorted.empty() ? -kPi / 4 : sorted[stray];
    projection.top = sorted.empty() ? kPi / 4 : sorted[sorted.size() - 1 - stray];
    if (!(projection.top - projection.bottom > kDegree)) projection.top = projection.bottom + kDegree;
  }
  if (config.rows == 0) {
    const float pitch = beamPitch(scan, elevation);
    const float rows = pitch > 0 ? std::round((projection.top - projection.bottom) / pitch) + 1 : 64;
    projection.rows = static_cast<int>(std::clamp(rows, 8.0F, 256.0F));
  }
  return projection;
}

RangeImage::RangeImage(const Projection& projection, const ScanPoints& scan) : projection_(projection) {
  const std::size_t pixels = static_cast<std::size_t>(projection.rows) * static_cast<std::size_t>(projection.columns);
  ranges_.assign(pixels, kEmpty);
  points_.assign(pixels, -1);
  std::vector<std::int32_t> pixel(scan.size());
  pixelsOf(projection, scan.x.data(), scan.y.data(), scan.z.data(), scan.size(), pixel.data());
  for (std::size_t k = 0; k < scan.size(); ++k) {
    if (pixel[k] < 0) continue;
    const auto at = static_cast<std::size_t>(pixel[k]);
    if (scan.range[k] < ranges_[at]) {
      ranges_[at] = scan.range[k];
      points_[at] = static_cast<std::int32_t>(k);
    }
  }
}

}  // namespace rhmap
