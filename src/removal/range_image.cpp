// SPDX-License-Identifier: BSD-3-Clause
#include "range_image.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "pixels.hpp"

namespace rhmap {
namespace {

constexpr int kSectors = 1800;        // 0.2 degrees: about what one shot of all beams covers
constexpr float kSameBeam = 0.0012F;  // [rad]; two points of a sector that are nearer in elevation are of one beam
constexpr float kSameShot = 0.0002F;  // [rad]; the same for azimuths
constexpr int kFewestColumns = 64;
constexpr int kFewest = 4;  // fewer points in a step are stray ones
constexpr float kDegree = kPi / 180;

/// Of these numbers; 0 if there are too few.
float median(std::vector<float>& numbers) {
  if (numbers.size() < 32) return 0;
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

/// Appends the steps between these angles that are larger than `same`.
void addSteps(std::vector<float>& angles, float same, std::vector<float>& steps) {
  std::sort(angles.begin(), angles.end());
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (const float step = angles[i] - angles[i - 1]; step > same) steps.push_back(step);
}

/// The median step in elevation between neighbouring beams [rad]; 0 if there are too few points to tell.
float beamPitch(const ScanPoints& scan, const std::vector<float>& elevation) {
  std::vector<std::vector<float>> sectors(kSectors);
  for (std::size_t k = 0; k < scan.size(); ++k) {
    const float turn = fastAtan2(scan.y[k], scan.x[k]) * (0.5F / kPi) + 0.5F;
    sectors[static_cast<std::size_t>(turn * kSectors) % kSectors].push_back(elevation[k]);
  }
  std::vector<float> steps;
  for (auto& sector : sectors) addSteps(sector, kSameBeam, steps);
  return median(steps);
}

/// The image's row of each point; below 0: none.
std::vector<std::int32_t> rowsOf(const Projection& projection, const ScanPoints& scan) {
  std::vector<std::int32_t> rows(scan.size());
  pixelsOf(projection, scan.x.data(), scan.y.data(), scan.z.data(), scan.size(), rows.data());
  for (std::int32_t& row : rows) row = row < 0 ? row : row / projection.columns;
  return rows;
}

/// Steps without points, between beams that are farther apart than others, go to the nearest row that has some.
void joinEmptySteps(Projection& projection, const ScanPoints& scan) {
  std::vector<int> points(projection.row.size(), 0);
  for (const std::int32_t step : rowsOf(projection, scan))  // still one row a step
    if (step >= 0) ++points[static_cast<std::size_t>(step)];
  std::vector<std::size_t> beams;
  for (std::size_t step = 0; step < points.size(); ++step)
    if (points[step] >= kFewest) beams.push_back(step);
  if (beams.size() < 2) return;
  std::size_t nearest = 0;
  for (std::size_t step = 0; step < points.size(); ++step) {
    while (nearest + 1 < beams.size() && 2 * step > beams[nearest] + beams[nearest + 1]) ++nearest;
    projection.row[step] = static_cast<std::int32_t>(nearest);
  }
  projection.rows = static_cast<int>(beams.size());
}

/// The median step in azimuth between points of the row that has most [rad]; 0 if there are too few to tell.
float shotPitch(const Projection& projection, const ScanPoints& scan) {
  std::vector<std::vector<float>> rows(static_cast<std::size_t>(projection.rows));
  const std::vector<std::int32_t> row = rowsOf(projection, scan);
  for (std::size_t k = 0; k < scan.size(); ++k)
    if (row[k] >= 0) rows[static_cast<std::size_t>(row[k])].push_back(fastAtan2(scan.y[k], scan.x[k]));
  std::vector<float> steps;
  addSteps(*std::max_element(rows.begin(), rows.end(), [](auto& a, auto& b) { return a.size() < b.size(); }), kSameShot,
           steps);
  return median(steps);
}

}  // namespace

Projection evenProjection(int rows, int columns, float top, float bottom) {
  Projection projection{.rows = rows, .columns = columns, .top = top, .bottom = bottom, .row = {}};
  projection.row.resize(static_cast<std::size_t>(rows));
  std::iota(projection.row.begin(), projection.row.end(), 0);
  return projection;
}

Projection measureProjection(const RangeImageConfig& config, const ScanPoints& scan) {
  float top = static_cast<float>(config.fov_up) * kDegree, bottom = static_cast<float>(config.fov_down) * kDegree;
  std::vector<float> elevation(scan.size());
  for (std::size_t k = 0; k < scan.size(); ++k)
    elevation[k] = fastAtan2(scan.z[k], std::sqrt(scan.x[k] * scan.x[k] + scan.y[k] * scan.y[k]));
  if (!(config.fov_up > config.fov_down)) {
    // A few stray points must not stretch the image.
    std::vector<float> sorted = elevation;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t stray = sorted.size() / 2000;
    bottom = sorted.empty() ? -kPi / 4 : sorted[stray];
    top = sorted.empty() ? kPi / 4 : sorted[sorted.size() - 1 - stray];
    if (!(top - bottom > kDegree)) top = bottom + kDegree;
  }
  Projection projection = evenProjection(config.rows, config.columns, top, bottom);
  if (config.rows == 0) {
    const float pitch = beamPitch(scan, elevation);
    const float steps = pitch > 0 ? std::round((top - bottom) / pitch) + 1 : 64;
    projection = evenProjection(static_cast<int>(std::clamp(steps, 8.0F, 256.0F)), config.columns, top, bottom);
    joinEmptySteps(projection, scan);
  }
  if (const float pitch = shotPitch(projection, scan); pitch > 0)
    projection.columns =
        std::min(config.columns, std::max(static_cast<int>(std::round(2 * kPi / pitch)), kFewestColumns));
  return projection;
}

RangeImage::RangeImage(const Projection& projection, const ScanPoints& scan) : projection_(projection) {
  const std::size_t pixels = static_cast<std::size_t>(projection.rows) * static_cast<std::size_t>(projection.columns);
  nearest_.assign(pixels, word(kEmpty, -1));
  constexpr std::size_t kBatch = 1024;
  std::array<std::int32_t, kBatch> pixel;
  for (std::size_t first = 0; first < scan.size(); first += kBatch) {
    const std::size_t n = std::min(kBatch, scan.size() - first);
    pixelsOf(projection, &scan.x[first], &scan.y[first], &scan.z[first], n, pixel.data());
    for (std::size_t i = 0; i < n; ++i) {
      if (pixel[i] < 0) continue;
      std::uint64_t& nearest = nearest_[static_cast<std::size_t>(pixel[i])];
      nearest = std::min(nearest, word(scan.range[first + i], static_cast<std::int32_t>(first + i)));
    }
  }
}

}  // namespace rhmap
