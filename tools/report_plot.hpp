// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace rhmap::tools {

/// A line of a plot.
struct PlotLine {
  std::string name;
  std::string colour;  ///< of CSS
  std::vector<double> values;
};

/// What is plotted over the number of the scan.
struct Plot {
  std::string title;
  std::string unit;
  bool logarithmic = false;  ///< decades upwards; values must be above 0
  std::size_t first_scan = 0;
  std::vector<PlotLine> lines;  ///< of one length
};

/// The plot as an SVG element.
std::string toSvg(const Plot& plot);

}  // namespace rhmap::tools
