// SPDX-License-Identifier: BSD-3-Clause
#include "report_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "html.hpp"

namespace rhmap::tools {
namespace {

// The picture [units of the SVG], and the part of it that the lines are in.
constexpr double kWidth = 640, kHeight = 320;
constexpr double kLeft = 64, kRight = 626, kTop = 58, kBottom = 280;

/// Where values are, upwards.
class Scale {
 public:
  explicit Scale(const Plot& plot) : logarithmic_(plot.logarithmic) {
    double low = 1e300, high = 0;
    for (const PlotLine& line : plot.lines)
      for (const double value : line.values) low = std::min(low, value), high = std::max(high, value);
    if (!(high > 0)) low = high = 1;
    if (logarithmic_) {
      low_ = std::floor(std::log10(low));
      high_ = std::max(std::ceil(std::log10(high)), low_ + 1);
      for (double decade = low_; decade <= high_; ++decade) ticks_.push_back(std::pow(10, decade));
    } else {
      const double decade = std::pow(10, std::floor(std::log10(high)));
      const double step = high / decade > 5 ? 2 * decade : high / decade > 2 ? decade : decade / 2;
      low_ = 0;
      high_ = step * std::ceil(high / step);
      for (double value = 0; value < high_ + step / 2; value += step) ticks_.push_back(value);
    }
  }

  double y(double value) const {
    const double place = ((logarithmic_ ? std::log10(value) : value) - low_) / (high_ - low_);
    return kBottom - place * (kBottom - kTop);
  }
  const std::vector<double>& ticks() const { return ticks_; }

 private:
  bool logarithmic_;
  double low_ = 0, high_ = 1;
  std::vector<double> ticks_;
};

std::string textAt(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, escapeHtml(text));
}

std::string grid(const Plot& plot, const Scale& scale, std::size_t scans) {
  std::string svg;
  for (const double tick : scale.ticks()) {
    svg += fmt::format("<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#e4e7ec\"/>\n", kLeft,
                       kRight, scale.y(tick));
    svg += textAt(kLeft - 8, scale.y(tick) + 4, "end", fmt::format("{:g}", tick));
  }
  svg += textAt(kLeft, kBottom + 18, "start", fmt::format("scan {}", plot.first_scan));
  svg += textAt(kRight, kBottom + 18, "end", fmt::format("scan {}", plot.first_scan + scans - 1));
  return svg;
}

std::string polyline(const PlotLine& line, const Scale& scale) {
  std::string points;
  const double steps = std::max(1., double(line.values.size()) - 1);
  for (std::size_t i = 0; i < line.values.size(); ++i)
    points += fmt::format("{:.1f},{:.1f} ", kLeft + (kRight - kLeft) * double(i) / steps, scale.y(line.values[i]));
  return fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"2\" points=\"{}\"/>\n", line.colour, points);
}

}  // namespace

std::string toSvg(const Plot& plot) {
  const Scale scale(plot);
  const std::size_t scans = plot.lines.empty() ? 1 : std::max<std::size_t>(1, plot.lines.front().values.size());
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" font-size=\"12\" "
      "fill=\"#262a30\">\n",
      kWidth, kHeight);
  svg += fmt::format("<text x=\"16\" y=\"24\" font-size=\"15\">{}</text>\n",
                     escapeHtml(plot.title + " [" + plot.unit + "]"));
  svg += grid(plot, scale, scans);
  double x = kLeft;
  for (const PlotLine& line : plot.lines) {
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"35\" width=\"14\" height=\"4\" fill=\"{}\"/>\n", x, line.colour);
    svg += textAt(x + 19, 41, "start", line.name);
    x += 40 + 7.5 * double(line.name.size());
    svg += polyline(line, scale);
  }
  return svg + "</svg>\n";
}

}  // namespace rhmap::tools
