// Curves on axes with units, as SVG that takes its colours from the page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/axis.hpp"

namespace dashpot::compiler {

// A class of the page's style sheet: one colour for each channel.
enum class Channel { total, brake, motor, closed_form, left_out };

struct Curve {
  std::string name;  // beside the plot; empty: without
  Channel channel;
  std::vector<double> x, y;  // as long as each other
  bool dashed = false;
  bool dots = false;  // a dot at each point in place of a line
};

// What an axis shows.
struct AxisTitle {
  std::string name;
  std::string unit;  // "1" for a plain number
};

struct Plot {
  std::string title;
  AxisTitle x_title, y_title;
  AxisScale x_scale, y_scale;
  std::vector<Curve> curves;
  bool zero_line = false;                          // shows 0 on the vertical axis, and its line
  std::optional<std::string> note = std::nullopt;  // below
};

// A <figure>. Points that are not finite, or not above zero on a logarithmic axis, are left out; a plot left without
// points is empty text.
std::string plot_figure(const Plot& plot);

}  // namespace dashpot::compiler
