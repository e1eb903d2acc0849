// SPDX-License-Identifier: BSD-3-Clause
#include "canvas.hpp"

#include <algorithm>
#include <cmath>

namespace rhmap::render {

void Canvas::paint(int x, int y, Colour colour, double cover) {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height || cover <= 0) return;
  Colour& pixel = image_.at(x, y);
  const std::uint8_t opaque = pixel.a;
  pixel = mix(pixel, colour, std::min(cover, 1.) * colour.a / 255);
  pixel.a = opaque;
}

void Canvas::fill(int x, int y, int width, int height, Colour colour) {
  for (int row = y; row < y + height; ++row)
    for (int column = x; column < x + width; ++column) paint(column, row, colour, 1);
}

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, Colour colour) {
  const Eigen::Vector2d along = to - from;
  const double half = 0.5 * width;
  const Eigen::Vector2d low = from.cwiseMin(to).array() - half - 1, high = from.cwiseMax(to).array() + half + 1;
  for (int y = int(std::floor(low.y())); y <= int(std::ceil(high.y())); ++y)
    for (int x = int(std::floor(low.x())); x <= int(std::ceil(high.x())); ++x) {
      const Eigen::Vector2d at = Eigen::Vector2d(x + 0.5, y + 0.5) - from;
      const double t = along.squaredNorm() > 0 ? std::clamp(at.dot(along) / along.squaredNorm(), 0., 1.) : 0;
      paint(x, y, colour, half + 0.5 - (at - t * along).norm());
    }
}

void Canvas::text(int x, int y, std::string_view text, int pixel_size, Colour colour) {
  const TextMask mask = font_.set(text, pixel_size);
  for (int row = 0; row < mask.height; ++row)
    for (int column = 0; column < mask.width; ++column)
      paint(x + column, y + row, colour,
            mask.coverage[std::size_t(row) * std::size_t(mask.width) + std::size_t(column)] / 255.);
}

}  // namespace rhmap::render
