// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string_view>

#include "font.hpp"
#include "rhmap/render/image.hpp"

namespace rhmap::render {

/// Draws shapes and text into a picture; what falls outside is cut off. Places in pixels from the top left.
class Canvas {
 public:
  explicit Canvas(Image& image) : image_(image) {}

  void fill(int x, int y, int width, int height, Colour colour);

  /// With round ends and smooth edges.
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, Colour colour);

  /// The line's top left corner is at x, y.
  void text(int x, int y, std::string_view text, int pixel_size, Colour colour);

  int textWidth(std::string_view text, int pixel_size) const { return font_.set(text, pixel_size).width; }
  int textHeight(int pixel_size) const { return font_.set("", pixel_size).height; }

 private:
  /// Paints a part of a pixel: `cover` is 0 to 1.
  void paint(int x, int y, Colour colour, double cover);

  Image& image_;
  Font font_;
};

}  // namespace rhmap::render
