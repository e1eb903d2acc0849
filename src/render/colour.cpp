// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/render/colour.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace rhmap::render {
namespace {

constexpr std::array<Colour, 7> kRamp{Colour{84, 92, 168},  Colour{62, 128, 182}, Colour{50, 164, 164},
                                      Colour{96, 192, 120}, Colour{178, 211, 79}, Colour{246, 211, 68},
                                      Colour{244, 158, 60}};

}  // namespace

Colour mix(Colour a, Colour b, double t) {
  const auto between = [t](std::uint8_t x, std::uint8_t y) {
    return static_cast<std::uint8_t>(std::lround(x + t * (double(y) - double(x))));
  };
  return {between(a.r, b.r), between(a.g, b.g), between(a.b, b.b), between(a.a, b.a)};
}

Colour rampColour(double t) {
  if (!(t > 0)) return kRamp.front();
  if (t >= 1) return kRamp.back();
  const double place = t * double(kRamp.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  return mix(kRamp[below], kRamp[below + 1], place - double(below));
}

}  // namespace rhmap::render
