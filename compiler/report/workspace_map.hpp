// What is told of a device's workspace as a picture: a map at one scale in x and y, as SVG that takes its colours from
// the page.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "axes/workspace.hpp"

namespace dashpot::compiler {

// An equal part of the workspace.
struct ShadedCell {
  axes::Pair<double> centre;  // [m]
  double level = 0;           // from 0, left blank, to `full`
  bool is_marked = false;     // hatched
};

struct DrawnLine {
  axes::Pair<double> from, to;  // [m]
  const char* kind;             // a class of the page's style sheet: "surface", "link", "bounds"
};

struct DrawnArrow {
  axes::Pair<double> at, along;  // `along` in the unit of the longest one
};

struct NamedPlace {
  axes::Pair<double> at;  // [m]
  std::string label;
};

struct WorkspaceMap {
  std::string title;
  axes::Box shown;  // [m]
  std::vector<ShadedCell> cells;
  axes::Pair<double> cell_size{0, 0};  // [m]
  std::vector<DrawnLine> lines;
  std::vector<DrawnArrow> arrows;
  double longest_arrow = 0;  // as drawn [m]
  std::vector<NamedPlace> dots;
  double full = 1;    // level of the darkest shade
  std::string scale;  // what levels are; empty: no scale of shades
  std::string note;   // below, as HTML
};

// Where x = 0, y = 0 is drawn, and how large a metre is; y grows upward on the map and downward in SVG.
struct MapFrame {
  double x_of_origin, y_of_origin, metre;
};
MapFrame frame_of(const WorkspaceMap& map);

// A <figure>.
std::string map_figure(const WorkspaceMap& map);

// Where a function over a box is 0, as short lines.
std::vector<DrawnLine> zero_lines(const axes::Box& box, const std::function<double(const axes::Pair<double>&)>& value,
                                  const char* kind);

}  // namespace dashpot::compiler
