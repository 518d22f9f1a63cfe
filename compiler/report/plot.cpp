#include "report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/markup.hpp"
#include "report/number_text.hpp"

namespace dashpot::compiler {
namespace {

constexpr double width = 440, height = 286;
constexpr double left = 62, right = 428, top = 12, bottom = 238;
constexpr double widest_digit = 8.5;  // of a tick's label, in the larger type of narrow pages

const char* class_of(Channel channel) {
  switch (channel) {
    case Channel::total: return "total";
    case Channel::brake: return "brake";
    case Channel::motor: return "motor";
    case Channel::closed_form: return "closed";
    case Channel::left_out: return "aside";
  }
  return "";
}

// "force [10⁻³ N]"
std::string text_of(const AxisTitle& title, const Axis& axis) {
  const std::string power = axis.power_of_ten == 0 ? "" : power_text(axis.power_of_ten);
  if (title.unit == "1") return title.name + (power.empty() ? "" : " [" + power + "]");
  return title.name + " [" + power + (power.empty() ? "" : " ") + title.unit + "]";
}

class Drawing {
 public:
  explicit Drawing(const Plot& plot) : plot_(plot) {
    for (const Curve& curve : plot.curves)
      for (std::size_t i = 0; i < curve.x.size(); ++i)
        if (is_shown(curve.x[i], curve.y[i])) extend(curve.x[i], curve.y[i]);
    if (is_empty()) return;
    if (plot.zero_line) y_range_ = {std::min(0.0, y_range_.low), std::max(0.0, y_range_.high)};
    x_ = axis(plot.x_scale, x_range_, 6);
    y_ = axis(plot.y_scale, y_range_, 5);
    if (plot.x_scale == AxisScale::linear) x_.shown = x_range_;
  }

  bool is_empty() const { return !(x_range_.high > x_range_.low); }

  std::string svg() const {
    std::string text = fmt::format("<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", width,
                                   height, escaped(plot_.title));
    text += grid() + frame() + tick_labels() + axis_labels();
    for (const Curve& curve : plot_.curves) text += drawn(curve);
    return text + "</svg>\n";
  }

 private:
  bool is_shown(double x, double y) const {
    return std::isfinite(x) && std::isfinite(y) && (plot_.x_scale == AxisScale::linear || x > 0) &&
           (plot_.y_scale == AxisScale::linear || y > 0);
  }

  void extend(double x, double y) {
    x_range_ = {std::min(x_range_.low, x), std::max(x_range_.high, x)};
    y_range_ = {std::min(y_range_.low, y), std::max(y_range_.high, y)};
  }

  // A logarithmic axis shows at least a decade on either side of a flat curve.
  static Axis axis(AxisScale scale, Interval range, int wanted) {
    if (scale == AxisScale::linear) return linear_axis(range, wanted);
    if (range.high < 3 * range.low) range = {range.low / 3, range.high * 3};
    return logarithmic_axis(range);
  }

  double x_at(double value) const { return left + x_.place(value) * (right - left); }
  double y_at(double value) const { return bottom - y_.place(value) * (bottom - top); }

  bool is_inside(const Tick& tick) const { return x_.place(tick.value) >= -1e-9 && x_.place(tick.value) <= 1 + 1e-9; }

  std::string grid() const {
    std::string path;
    for (const Tick& tick : x_.ticks)
      if (is_inside(tick)) path += fmt::format("M{:.1f} {}V{}", x_at(tick.value), top, bottom);
    for (const Tick& tick : y_.ticks) path += fmt::format("M{} {:.1f}H{}", left, y_at(tick.value), right);
    return "<path class=\"grid\" d=\"" + path + "\"/>\n";
  }

  std::string frame() const {
    std::string text = fmt::format("<path class=\"frame\" d=\"M{} {}V{}H{}\"/>\n", left, top, bottom, right);
    if (plot_.zero_line) text += fmt::format("<path class=\"zero\" d=\"M{} {:.1f}H{}\"/>\n", left, y_at(0), right);
    return text;
  }

  // A label at the right end, which would run off the drawing were it set around its tick.
  bool ends_beyond(const Tick& tick) const {
    const auto is_a_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
    const auto characters = std::count_if(tick.label.begin(), tick.label.end(), is_a_character);
    return x_at(tick.value) + widest_digit * static_cast<double>(characters) / 2 > width;
  }

  std::string tick_labels() const {
    std::string text;
    for (const Tick& tick : x_.ticks)
      if (is_inside(tick) && !tick.label.empty())
        text += fmt::format("<text class=\"tick{}\" x=\"{:.1f}\" y=\"{}\">{}</text>", ends_beyond(tick) ? " last" : "",
                            ends_beyond(tick) ? width : x_at(tick.value), bottom + 17, tick.label);
    for (const Tick& tick : y_.ticks)
      if (!tick.label.empty())
        text += fmt::format("<text class=\"tick y\" x=\"{}\" y=\"{:.1f}\">{}</text>", left - 7, y_at(tick.value) + 4,
                            tick.label);
    return text + "\n";
  }

  std::string axis_labels() const {
    const double middle = (top + bottom) / 2;
    return fmt::format("<text class=\"label\" x=\"{}\" y=\"{}\">{}</text>", (left + right) / 2, height - 10,
                       escaped(text_of(plot_.x_title, x_))) +
           fmt::format("<text class=\"label\" x=\"12\" y=\"{0}\" transform=\"rotate(-90 12 {0})\">{1}</text>\n", middle,
                       escaped(text_of(plot_.y_title, y_)));
  }

  std::string drawn(const Curve& curve) const {
    std::string path;
    bool pen_down = false;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      const bool shown = is_shown(curve.x[i], curve.y[i]);
      // A line of no length with a round cap is a dot.
      if (shown)
        path += fmt::format("{}{:.1f} {:.1f}{}", pen_down && !curve.dots ? "L" : "M", x_at(curve.x[i]),
                            y_at(curve.y[i]), curve.dots ? "h0" : "");
      pen_down = shown;
    }
    return fmt::format("<path class=\"curve {}{}{}\" d=\"{}\"/>\n", class_of(curve.channel),
                       curve.dashed ? " dashed" : "", curve.dots ? " dots" : "", path);
  }

  const Plot& plot_;
  static constexpr double endless = std::numeric_limits<double>::infinity();
  Interval x_range_{endless, -endless}, y_range_{endless, -endless};
  Axis x_{}, y_{};
};

std::string legend(const Plot& plot) {
  std::string keys;
  for (const Curve& curve : plot.curves)
    if (!curve.name.empty())
      keys += fmt::format("<span class=\"key {}{}{}\">{}</span>", class_of(curve.channel),
                          curve.dashed ? " dashed" : "", curve.dots ? " dots" : "", escaped(curve.name));
  return keys.empty() ? "" : "<p class=\"legend\">" + keys + "</p>\n";
}

}  // namespace

std::string plot_figure(const Plot& plot) {
  const Drawing drawing(plot);
  if (drawing.is_empty()) return "";
  std::string text = "<figure>\n<figcaption>" + escaped(plot.title) + "</figcaption>\n" + legend(plot) + drawing.svg();
  if (plot.note) text += "<p class=\"note\">" + escaped(*plot.note) + "</p>\n";
  return text + "</figure>\n";
}

}  // namespace dashpot::compiler
