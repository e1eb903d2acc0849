// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include <span>
#include <vector>

namespace rhmap::eval {

/// How a labelled point counts.
enum class Kind : std::uint8_t { kIgnored, kStatic, kDynamic };

/// SemanticKITTI's moving classes, and 251, which they do not use: our clip's movers outside of the camera's view.
inline constexpr std::array<std::uint16_t, 9> kMovingClasses{251, 252, 253, 254, 255, 256, 257, 258, 259};

/// What nobody labelled; it is in the map, but never counted.
inline constexpr std::array<std::uint16_t, 1> kIgnoredClasses{0};

/// The one place that says which classes move. A class that is neither dynamic nor ignored is static.
class Labels {
 public:
  Labels() : Labels(kMovingClasses, kIgnoredClasses) {}

  /// Other classes; std::invalid_argument if one is in both lists.
  Labels(std::span<const std::uint16_t> dynamic, std::span<const std::uint16_t> ignored);

  /// Looks at the low 16 bits, SemanticKITTI's class; the upper ones hold the instance.
  Kind kind(std::uint32_t label) const { return kinds_[label & 0xffffU]; }

  bool isDynamic(std::uint32_t label) const { return kind(label) == Kind::kDynamic; }

 private:
  std::vector<Kind> kinds_;
};

}  // namespace rhmap::eval
