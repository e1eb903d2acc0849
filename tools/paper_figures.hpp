// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace rhmap::tools {

/// PR and RR in per cent, F1 as a fraction of 1.
struct PublishedScore {
  double pr;
  double rr;
  double f1;
};

/// A part of a sequence of SemanticKITTI and what RH-Map's paper says of itself there.
struct PublishedWindow {
  std::string_view sequence;
  std::size_t first;
  std::size_t last;
  PublishedScore front_end;  ///< Table I, "RH-Map (Front-end)"
  PublishedScore both;       ///< Table I, "RH-Map (Ours)"
  double milliseconds;       ///< Table II, mean of a scan on an i7-12700H
  double hertz;
};

/// Figures as they are printed (02's 0.867 is 0.86745 by its PR and RR). The paper does not state the frames; these are
/// the clips of ERASOR, which its figures show.
inline constexpr std::array<PublishedWindow, 5> kPublished{{
    {"00", 4390, 4530, {97.8724, 97.788, 0.978302}, {94.6446, 98.005, 0.962955}, 63.9573, 15.6354},
    {"01", 150, 250, {92.9481, 77.1859, 0.843369}, {91.454, 90.2589, 0.908525}, 93.2319, 10.7259},
    {"02", 860, 950, {98.855, 77.2788, 0.867}, {90.4409, 91.2651, 0.908511}, 66.9781, 14.9303},
    {"05", 2350, 2670, {97.2321, 96.6255, 0.969278}, {94.713, 98.5007, 0.965697}, 64.6114, 15.4771},
    {"07", 630, 820, {97.3686, 91.2949, 0.94234}, {96.4697, 97.8803, 0.971699}, 51.0236, 19.5988},
}};

}  // namespace rhmap::tools
