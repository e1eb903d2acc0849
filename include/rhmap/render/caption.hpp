// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "rhmap/render/camera.hpp"
#include "rhmap/render/colouring.hpp"
#include "rhmap/render/image.hpp"

namespace rhmap::render {

/// What a colour stands for.
struct LegendEntry {
  Colour colour;
  std::string label;
};

/// What a ramp of colours stands for, e.g. {"height", "m", {-2, 5}}.
struct LegendRamp {
  std::string label;
  std::string unit;
  Range range;
};

/// What is written on a picture; what is empty is left out.
struct Caption {
  std::string title = {};
  std::vector<LegendEntry> entries = {};
  std::vector<LegendRamp> ramps = {};
  bool scale_bar = true;  ///< metres at the camera's target
  bool axes = true;       ///< x red, y green, z blue, as robots' axes are
};

/// Writes it into the picture's corners: title and legend above left, scale bar below left, axes below right. Sizes go
/// with the picture's height. Text is UTF-8.
void drawCaption(Image& image, const Camera& camera, const Caption& caption);

/// The longest of 1, 2, 5, 10, 20, 50, ... (and 0.5, 0.2, 0.1, ...) that is not above `limit` (above 0).
double roundLength(double limit);

}  // namespace rhmap::render
