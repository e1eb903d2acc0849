// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/render/caption.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "canvas.hpp"

namespace rhmap::render {
namespace {

constexpr Colour kInk{38, 42, 48};
constexpr Colour kPaper{255, 255, 255, 214};  ///< behind text, so that it can be read on any picture

/// Lengths that go with the picture [pixels].
struct Layout {
  explicit Layout(const Image& image) : text(std::max(9, image.height / 42)) {}

  int text;                  ///< size of the letters
  int title = text * 5 / 4;  ///< of the title's
  int margin = text;         ///< from the picture's edge
  int gap = std::max(3, text / 2);
};

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

/// Title and legend, on one piece of paper.
class Header {
 public:
  Header(Canvas& canvas, const Layout& layout, const Caption& caption)
      : canvas_(canvas), layout_(layout), caption_(caption) {}

  void draw() {
    if (caption_.title.empty() && caption_.entries.empty() && caption_.ramps.empty()) return;
    const int x = layout_.margin + layout_.gap;
    canvas_.fill(layout_.margin, layout_.margin, width() + 2 * layout_.gap, height() + 2 * layout_.gap, kPaper);
    int y = layout_.margin + layout_.gap;
    if (!caption_.title.empty()) {
      canvas_.text(x, y, caption_.title, layout_.title, kInk);
      y += titleRow();
    }
    for (const LegendEntry& entry : caption_.entries) {
      Colour colour = entry.colour;
      colour.a = 255;
      canvas_.fill(x, y + (row() - layout_.text) / 2, layout_.text, layout_.text, colour);
      canvas_.text(x + layout_.text + layout_.gap, y, entry.label, layout_.text, kInk);
      y += row();
    }
    for (const LegendRamp& ramp : caption_.ramps) {
      drawRamp(ramp, x, y);
      y += row();
    }
  }

 private:
  int row() const { return canvas_.textHeight(layout_.text) + layout_.gap / 2; }
  int titleRow() const { return canvas_.textHeight(layout_.title) + layout_.gap / 2; }
  int rampWidth() const { return 8 * layout_.text; }
  static std::string first(const LegendRamp& ramp) { return ramp.label + "  " + number(ramp.range.min); }
  static std::string last(const LegendRamp& ramp) {
    return number(ramp.range.max) + (ramp.unit.empty() ? "" : " " + ramp.unit);
  }

  int width() const {
    int width = canvas_.textWidth(caption_.title, layout_.title);
    for (const LegendEntry& entry : caption_.entries)
      width = std::max(width, layout_.text + layout_.gap + canvas_.textWidth(entry.label, layout_.text));
    for (const LegendRamp& ramp : caption_.ramps)
      width = std::max(width, canvas_.textWidth(first(ramp), layout_.text) + rampWidth() + 2 * layout_.gap +
                                  canvas_.textWidth(last(ramp), layout_.text));
    return width;
  }

  int height() const {
    return (caption_.title.empty() ? 0 : titleRow()) + int(caption_.entries.size() + caption_.ramps.size()) * row();
  }

  void drawRamp(const LegendRamp& ramp, int x, int y) {
    canvas_.text(x, y, first(ramp), layout_.text, kInk);
    x += canvas_.textWidth(first(ramp), layout_.text) + layout_.gap;
    for (int i = 0; i < rampWidth(); ++i)
      canvas_.fill(x + i, y + (row() - layout_.text) / 2, 1, layout_.text, rampColour(double(i) / (rampWidth() - 1)));
    canvas_.text(x + rampWidth() + layout_.gap, y, last(ramp), layout_.text, kInk);
  }

  Canvas& canvas_;
  const Layout& layout_;
  const Caption& caption_;
};

void drawScaleBar(Canvas& canvas, const Layout& layout, const Image& image, const Camera& camera) {
  const double scale = Projection(camera, image.width, image.height).pixelsPerMetre();
  const double length = roundLength(0.2 * image.width / scale);
  const int width = int(std::lround(length * scale));
  const std::string label = number(length) + " m";
  const int height = canvas.textHeight(layout.text), bar = std::max(3, layout.text / 4);
  const int x = layout.margin + layout.gap;
  const int y = image.height - layout.margin - layout.gap - bar - height;
  canvas.fill(layout.margin, y - layout.gap / 2, std::max(width, canvas.textWidth(label, layout.text)) + 2 * layout.gap,
              height + bar + layout.gap * 3 / 2, kPaper);
  canvas.text(x, y, label, layout.text, kInk);
  canvas.fill(x, y + height, width, bar, kInk);
}

/// The directions of the world's axes, those that point away from the viewer first.
void drawAxes(Canvas& canvas, const Layout& layout, const Image& image, const Camera& camera) {
  struct Axis {
    Eigen::Vector3d seen;
    Colour colour;
    const char* name;
  };
  const Eigen::Matrix3d view = viewOf(camera).linear();
  std::array<Axis, 3> axes{Axis{view.col(0), {206, 52, 52}, "x"}, Axis{view.col(1), {44, 150, 70}, "y"},
                           Axis{view.col(2), {52, 92, 210}, "z"}};
  std::sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return a.seen.z() < b.seen.z(); });
  const double arm = 2.4 * layout.text;
  const double inset = layout.margin + arm + layout.text;
  const Eigen::Vector2d origin(image.width - inset, image.height - inset);
  const int side = int(2 * (arm + layout.text));
  canvas.fill(image.width - layout.margin - side, image.height - layout.margin - side, side, side, kPaper);
  for (const Axis& axis : axes) {
    const Eigen::Vector2d along(axis.seen.x(), -axis.seen.y());
    if (along.norm() < 0.05) continue;  // straight towards the viewer or away
    canvas.line(origin, origin + arm * along, std::max(2., layout.text / 7.), axis.colour);
    const Eigen::Vector2d at = origin + (arm + 0.6 * layout.text) * along;
    canvas.text(int(at.x()) - canvas.textWidth(axis.name, layout.text) / 2, int(at.y()) - layout.text * 5 / 8,
                axis.name, layout.text, axis.colour);
  }
}

}  // namespace

double roundLength(double limit) {
  const double decade = std::pow(10, std::floor(std::log10(limit)));
  for (const double step : {5., 2.})
    if (step * decade <= limit) return step * decade;
  return decade;
}

void drawCaption(Image& image, const Camera& camera, const Caption& caption) {
  Canvas canvas(image);
  const Layout layout(image);
  if (caption.scale_bar) drawScaleBar(canvas, layout, image, camera);
  if (caption.axes) drawAxes(canvas, layout, image, camera);
  Header(canvas, layout, caption).draw();
}

}  // namespace rhmap::render
