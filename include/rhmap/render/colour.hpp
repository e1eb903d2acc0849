// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace rhmap::render {

/// A colour as it is in the picture (sRGB); `a` is its opacity.
struct Colour {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  std::uint8_t a = 255;

  bool operator==(const Colour&) const = default;
};

// What the colours of a picture of rhmap mean, everywhere.
inline constexpr Colour kKept{170, 180, 192};      ///< static, and in the map
inline constexpr Colour kRemoved{52, 152, 110};    ///< moved, and is gone
inline constexpr Colour kMissed{222, 38, 38};      ///< moved, and is still in the map
inline constexpr Colour kLost{240, 160, 30};       ///< static, and is gone
inline constexpr Colour kGround{190, 164, 122};    ///< carries the robot
inline constexpr Colour kNonGround{74, 124, 176};  ///< stands on the ground
inline constexpr Colour kFreeSpace{90, 160, 230, 26};
inline constexpr Colour kTrajectory{38, 88, 214};

/// The colour at `t` (0 ... 1, clamped; NaN is 0) of the ramp from blue over green to orange; red is left to kMissed.
Colour rampColour(double t);

/// Between `a` (t = 0) and `b` (t = 1).
Colour mix(Colour a, Colour b, double t);

}  // namespace rhmap::render
