// SPDX-License-Identifier: BSD-3-Clause
#include "visibility.hpp"

#include <algorithm>

#include "pixels.hpp"

namespace rhmap {
namespace {

constexpr double kFarthestStep = 40;  // [m]; a cube beyond needs no window of its own

using Vector = std::array<float, 3>;

float dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
float squared(const Vector& a) { return dot(a, a); }
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

float squaredDistanceToSegment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector d = minus(b, a), e = minus(p, a);
  const float dd = squared(d), t = dd > 0 ? std::clamp(dot(d, e) / dd, 0.0F, 1.0F) : 0.0F;
  return squared({e[0] - t * d[0], e[1] - t * d[1], e[2] - t * d[2]});
}

/// Of the line through a and b from the sensor.
float squaredDistanceOfLine(const Vector& a, const Vector& b) {
  const Vector across{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  return squared(across) / std::max(squared(minus(b, a)), 1e-9F);
}

/// Of the ray to `end` from a place.
float squaredDistanceOfRay(const Vector& p, const Vector& end) {
  const float along = dot(p, end);
  return squared(p) - along * along / squared(end);
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
      ranges_(image.size()),
      points_(std::make_unique_for_overwrite<std::array<float, 3>[]>(image.size())),
      behind_(static_cast<float>(config.behind)),
      before_(static_cast<float>(config.before)),
      aside_(static_cast<float>(config.aside)),
      aside_share_(static_cast<float>(config.aside_share)),
      surface_(static_cast<float>(config.surface)),
      surface_share_(static_cast<float>(config.surface_share)),
      clearance_(static_cast<float>(config.clearance)),
      skim_(static_cast<float>(config.skim)),
      skim_from_(static_cast<float>(config.skim_from)),
      edge_(static_cast<float>(1 + config.edge_share)),
      least_up_(config.window) {
  for (std::size_t i = 0; i < image.size(); ++i) ranges_[i] = image.range(i);
  for (std::size_t i = 0; i < image.size() && scan.size() > 0; ++i) {
    const auto at = static_cast<std::size_t>(std::max(image.point(i), 0));  // nobody asks for those of empty pixels
    points_[i] = {scan.x[at], scan.y[at], scan.z[at]};
  }

  middle_.assign(static_cast<std::size_t>(projection_.rows), 0);
  for (int i = 0; i < projection_.rows; ++i) {
    const auto [first, last] = std::equal_range(projection_.row.begin(), projection_.row.end(), i);
    middle_[static_cast<std::size_t>(i)] =
        static_cast<int>(first - projection_.row.begin() + (last - 1 - projection_.row.begin())) / 2;
  }
  const double radius = std::min(cube * std::sqrt(3.0) / 2, config.ball);
  const double steps = double(projection_.stepsPerRadian()), columns = projection_.columns / (2 * double(kPi));
  const auto pixels = [&](double count) {
    return static_cast<std::int8_t>(std::clamp(static_cast<int>(std::ceil(count)), config.window, 64));
  };
  for (int near = 0; near < kFarthestStep * double(kStepsPerMetre); ++near) {
    const double angle = radius / std::max((near + 0.5) / double(kStepsPerMetre), 1.0);
    windows_.push_back({pixels(angle * steps), pixels(angle * columns)});
  }

  // The farthest of each block, then of blocks twice as large.
  const auto blocks = [](int pixels, int block) { return (pixels + block - 1) / block; };
  Farthest own{
      kSmallestBlock, blocks(projection_.rows, kSmallestBlock), blocks(projection_.columns, kSmallestBlock), {}};
  own.ranges.assign(static_cast<std::size_t>(own.rows * own.columns), 0.0F);
  std::vector<float> farthest(static_cast<std::size_t>(own.columns * kSmallestBlock));  // of the rows of a block
  for (int i = 0; i < projection_.rows; i += kSmallestBlock) {
    std::fill(farthest.begin(), farthest.end(), 0.0F);
    for (int row = i; row < std::min(i + kSmallestBlock, projection_.rows); ++row) {
      const float* from = &ranges_[static_cast<std::size_t>(row * projection_.columns)];
      for (std::size_t j = 0; j < static_cast<std::size_t>(projection_.columns); ++j)
        farthest[j] = std::max(farthest[j], from[j] < RangeImage::kEmpty ? from[j] : 0.0F);
    }
    float* to = &own.ranges[static_cast<std::size_t>(i / kSmallestBlock * own.columns)];
    for (std::size_t j = 0; j < farthest.size(); ++j)
      to[j / kSmallestBlock] = std::max(to[j / kSmallestBlock], farthest[j]);
  }
  while (own.rows > 2) {
    summarise(own);
    Farthest larger{2 * own.block, blocks(own.rows, 2), blocks(own.columns, 2), {}};
    larger.ranges.assign(static_cast<std::size_t>(larger.rows * larger.columns), 0.0F);
    for (int i = 0; i < own.rows; ++i) {
      for (int j = 0; j < own.columns; ++j) {
        float& to = larger.ranges[static_cast<std::size_t>(i / 2 * larger.columns + j / 2)];
        to = std::max(to, own.ranges[static_cast<std::size_t>(i * own.columns + j)]);
      }
    }
    own = std::move(larger);
  }
}

/// Keeps for each block the farthest of it and of those around.
void Visibility::summarise(const Farthest& own) {
  Farthest around = own;
  for (int i = 0; i < own.rows; ++i) {
    for (int j = 0; j < own.columns; ++j) {
      float& farthest = around.ranges[static_cast<std::size_t>(i * own.columns + j)];
      for (int di = std::max(-1, -i); di <= std::min(1, own.rows - 1 - i); ++di) {
        const float* row = &own.ranges[static_cast<std::size_t>((i + di) * own.columns)];
        farthest =
            std::max({farthest, row[j == 0 ? own.columns - 1 : j - 1], row[j], row[j + 1 == own.columns ? 0 : j + 1]});
      }
    }
  }
  farthest_.push_back(std::move(around));
}

/// Most cubes are behind something, or are what is seen: which of them is chosen without branches.
inline Look Visibility::at(const std::array<float, 3>& p, float range, std::int32_t pixel) const {
  const float centre = ranges_[static_cast<std::size_t>(std::max(pixel, 0))];
  bool unknown = (pixel < 0) | (centre < range - before_);
  // Above the first row's beam nothing would show a surface that runs on towards the sensor: a ceiling.
  const bool in_first_row = pixel >= 0 && pixel < projection_.columns;
  if (in_first_row && centre < range * edge_) unknown |= projection_.stepOf(p[0], p[1], p[2]) < kFirstBeam;
  if (!unknown && centre > range + behind_) return around(p, range, pixel);
  return unknown ? Look::kUnknown : Look::kFilled;
}

Look Visibility::at(const std::array<float, 3>& p) const {
  std::int32_t pixel = -1;
  float range = 0;
  pixelsOf(projection_, &p[0], &p[1], &p[2], 1, &pixel, &range);
  return at(p, range, pixel);
}

void Visibility::look(const SensorView& from, std::span<const CubesAt> places, std::span<CubeLooks> looks) const {
  const SensorView view = from;        // which no write below can change, so that the loop over it becomes vector code
  constexpr std::size_t kBatch = 512;  // cubes, in a few loops that are vector code
  std::array<float, kBatch> x, y, z, range;
  std::array<std::int32_t, kBatch> pixels;
  for (std::size_t first = 0, last = 0; first < places.size(); first = last) {
    std::size_t n = 0;
    for (; last < places.size() && n + 64 <= kBatch; ++last) {
      const OcTreeKey& corner = places[last].corner;
      forEachBit(places[last].cubes, [&](int bit) {
        const OcTreeKey cube = cubeOf(corner, bit);
        x[n] = static_cast<float>(cube[0]), y[n] = static_cast<float>(cube[1]), z[n] = static_cast<float>(cube[2]);
        ++n;
      });
    }
    for (std::size_t i = 0; i < n; ++i) {
      const auto [px, py, pz] = view(x[i], y[i], z[i]);
      x[i] = px, y[i] = py, z[i] = pz;
    }
    pixelsOf(projection_, x.data(), y.data(), z.data(), n, pixels.data(), range.data());
    for (std::size_t place = first, i = 0; place < last; ++place) {
      CubeLooks& of = looks[place] = {};
      for (std::uint64_t rest = places[place].cubes; rest != 0; rest &= rest - 1, ++i) {
        const Look look = at({x[i], y[i], z[i]}, range[i], pixels[i]);
        const std::uint64_t cube = rest & -rest;
        of.filled |= look == Look::kFilled ? cube : 0;
        of.seen_through |= look == Look::kSeenThrough ? cube : 0;
        of.skimmed |= look == Look::kSkimmed ? cube : 0;
      }
    }
  }
}

bool Visibility::hides(const std::array<float, 3>& p, float radius) const {
  const float range = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  // The blocks around reach at least a block's width to all sides; a window of pixels comes on top.
  const float level = std::max(std::sqrt(p[0] * p[0] + p[1] * p[1]), 1e-3F);
  const float pixels_per_radian =
      std::max(projection_.stepsPerRadian(), static_cast<float>(projection_.columns) / (2 * kPi));
  const float reach = 1.1F * radius / level * pixels_per_radian + 1;
  for (const Farthest& farthest : farthest_) {
    if (static_cast<float>(farthest.block) < reach) continue;
    const float step =
        std::clamp(projection_.stepOf(p[0], p[1], p[2]), 0.0F, static_cast<float>(projection_.steps() - 1));
    const int row = projection_.row[static_cast<std::size_t>(step)];
    const int block = row / farthest.block * farthest.columns + projection_.columnOf(p[0], p[1]) / farthest.block;
    return farthest.ranges[static_cast<std::size_t>(block)] <= range - radius + behind_;
  }
  return false;
}

Look Visibility::around(const Vector& p, float range, std::int32_t pixel) const {
  const auto centre = static_cast<std::size_t>(pixel);
  const float behind = range + behind_, before = range - before_;
  const int row = pixel / projection_.columns, column = pixel % projection_.columns;
  const auto near = static_cast<std::size_t>(range * kStepsPerMetre);
  const Window window = near < windows_.size() ? windows_[near] : windows_.back();
  const int step = middle_[static_cast<std::size_t>(row)];
  const auto rowAt = [this](int i) {
    return projection_.row[static_cast<std::size_t>(std::clamp(i, 0, projection_.steps() - 1))];
  };
  const int top = std::max(0, std::min(row - least_up_, rowAt(step - window.up)));
  const int bottom = std::min(projection_.rows - 1, std::max(row + least_up_, rowAt(step + window.up)));
  const auto any = [&](auto&& holds) {
    for (int i = top; i <= bottom; ++i) {
      for (int c = column - window.beside; c <= column + window.beside; ++c) {
        const int j = c < 0 ? c + projection_.columns : c >= projection_.columns ? c - projection_.columns : c;
        if (holds(static_cast<std::size_t>(i * projection_.columns + j), j)) return true;
      }
    }
    return false;
  };

  // Most have something at their place; no point needs to be known for that. Row by row without branches.
  const int first = column - window.beside, last = column + window.beside;
  bool nearer = false;
  for (int i = top; i <= bottom; ++i) {
    const float* ranges = &ranges_[static_cast<std::size_t>(i * projection_.columns)];
    bool filled = false;
    const auto lookAt = [&](int from, int to) {
      for (int j = from; j <= to; ++j) {
        filled |= (ranges[j] >= before) & (ranges[j] <= behind);
        nearer |= ranges[j] < before;
      }
    };
    lookAt(std::max(first, 0), std::min(last, projection_.columns - 1));
    if (first < 0) lookAt(first + projection_.columns, projection_.columns - 1);
    if (last >= projection_.columns) lookAt(0, last - projection_.columns);
    if (filled) return Look::kFilled;
  }

  // Something nearer beside the cube: a surface may run from there to what is seen at the cube's own pixel. But not
  // from what stands in the next column to what is far behind it: the line between them all but meets the sensor, and
  // walls are farther away. Within a column, roofs level with the sensor run along such a line, though hardly for long.
  const float surface = std::max(surface_, surface_share_ * range);
  bool skimmed = false;
  const auto isSurface = [&](const Vector& nearer, bool same_column) {
    const Vector& own = points_[centre];
    if (squaredDistanceToSegment(p, nearer, own) >= surface * surface) return false;
    const float passes = squaredDistanceOfLine(nearer, own);
    if (!same_column) return passes >= clearance_ * clearance_;
    if (passes >= skim_ * skim_ || squared(minus(p, nearer)) < skim_from_ * skim_from_) return true;
    skimmed = true;
    return false;
  };
  const bool empty = ranges_[centre] == RangeImage::kEmpty;
  if (nearer && any([&](std::size_t at, int j) {
        return ranges_[at] < before && (empty || isSurface(points_[at], j == column));
      }))
    return Look::kUnknown;

  const float aside = std::max(aside_, aside_share_ * range);
  const bool seen = any([&](std::size_t at, int) {
    return ranges_[at] > behind && ranges_[at] < RangeImage::kEmpty &&
           squaredDistanceOfRay(p, points_[at]) <= aside * aside;
  });
  if (!seen) return Look::kUnknown;
  return skimmed ? Look::kSkimmed : Look::kSeenThrough;
}

}  // namespace rhmap
