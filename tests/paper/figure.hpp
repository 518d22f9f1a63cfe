// A figure of panels with curves, drawn as SVG in one hand: everything that the experiments show is drawn by to_svg().
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "axis.hpp"
#include "maker.hpp"

namespace dashpot::paper {

enum class Marker { none, circle, cross };

struct Style {
  const char* colour;
  double width = 0;         // of the line [1/4 mm in print]; 0: markers alone
  const char* dashes = "";  // stroke-dasharray, "": solid
  Marker marker = Marker::none;
};

// Apart in grey too, and for eyes that do not tell red from green. The paper's ideal is a thick grey line.
inline constexpr Style ideal{"#b8b8b8", 4};
inline constexpr Style emitted{"#0b5fa5", 0, "", Marker::circle};
inline constexpr Style emitted_euler{"#c1440e", 0, "", Marker::cross};
inline constexpr Style plain{"#1a1a1a", 1.6};
inline constexpr Style single_motor{"#c1440e", 1.8};
inline constexpr Style dual_channel{"#0b5fa5", 1.4};
inline constexpr Style third{"#2f8f5b", 1.4, "6 3"};
inline constexpr Style fourth{"#8a4fa8", 1.6, "2 2"};
inline constexpr Style bound{"#1a1a1a", 1.2, "2 3"};

struct Curve {
  std::string name;  // in the legend, once a figure; "": not there
  Style style;
  std::vector<double> x, y;  // as long as each other, finite
  Maker maker = Maker::emitted;

  std::string label() const { return name + label_of(maker); }  // in the legend
};

struct Panel {
  std::string title;
  std::string x_label, y_label;  // with units: "time [s]"
  std::vector<Curve> curves;
  std::optional<Interval> x_range = {}, y_range = {};  // shown alone; else all values, and zero where the scale has one
  Scale x_scale = Scale::linear, y_scale = Scale::linear;
  bool wide = false;  // has a row to itself
};

struct Figure {
  std::string title;
  std::vector<std::string> caption;  // lines under the panels
  std::vector<Panel> panels;         // two a row or one that is wide, left to right, then down
};

// The whole file, standing alone: no fonts, styles or scripts from elsewhere. 180 mm wide in print.
std::string to_svg(const Figure& figure);

// Text as SVG and HTML have it between tags.
std::string escaped(const std::string& text);

}  // namespace dashpot::paper
