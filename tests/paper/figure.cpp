#include "figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dashpot::paper {
namespace {

// On paper [1/4 mm]; y grows downwards.
struct Point {
  double x, y;
};
struct Box {
  double left, top, right, bottom;
};

constexpr double page_width = 720;
constexpr double legend_line = 18;
constexpr double row_height = 235;
constexpr double caption_line = 17;
constexpr Box margin{72, 26, 20, 46};  // of a panel, for title, ticks and labels
constexpr double marker_radius = 2.8;

std::string text(Point at, const std::string& words, const char* attributes = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", at.x, at.y, attributes, escaped(words));
}

std::string line(Point from, Point to, const char* attributes) {
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" {}/>\n", from.x, from.y, to.x, to.y, attributes);
}

std::string marker(const Style& style, Point at) {
  constexpr double r = marker_radius;
  if (style.marker == Marker::circle)
    return fmt::format(
        "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"white\" stroke=\"{}\" stroke-width=\"1.4\"/>\n", at.x,
        at.y, r, style.colour);
  return fmt::format("<path d=\"M{0:.2f} {1:.2f}l{2} {2}m0 -{2}l-{2} {2}\" stroke=\"{3}\" stroke-width=\"1.3\"/>\n",
                     at.x - r, at.y - r, 2 * r, style.colour);
}

// Positions to a tenth, 25 µm in print; each from the last that was written, so that roundings do not add up.
std::string polyline(const Style& style, const std::vector<Point>& points) {
  std::string path;
  long x = 0, y = 0;  // tenths
  for (const Point& p : points) {
    const long right = std::lround(10 * p.x) - x, down = std::lround(10 * p.y) - y;
    path += fmt::format("{}{:g} {:g}", path.empty() ? "M" : "l", double(right) / 10, double(down) / 10);
    x += right, y += down;
  }
  return fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-dasharray=\"{}\" "
      "stroke-linejoin=\"round\"/>\n",
      path, style.colour, style.width, *style.dashes ? style.dashes : "none");
}

std::string drawn(const Style& style, const std::vector<Point>& points) {
  std::string svg = style.width > 0 ? polyline(style, points) : "";
  if (style.marker != Marker::none)
    for (const Point& p : points) svg += marker(style, p);
  return svg;
}

bool shows(const std::optional<Interval>& range, double value) {
  return !range || (value >= range->low && value <= range->high);
}

// Of the numbers, x or y, of all points that lie in the panel's range of x.
Interval extent(const Panel& panel, std::vector<double> Curve::*numbers, Scale scale) {
  constexpr double unset = std::numeric_limits<double>::infinity();
  Interval all{unset, -unset};
  for (const Curve& curve : panel.curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      const double value = (curve.*numbers)[i];
      if (shows(panel.x_range, curve.x[i])) all = {std::min(all.low, value), std::max(all.high, value)};
    }
  if (scale == Scale::logarithmic) return all;
  return {std::min(all.low, 0.0), std::max(all.high, 0.0)};  // zero is shown: forces and motions start there
}

Axis axis_of(const Panel& panel, std::vector<double> Curve::*numbers, const std::optional<Interval>& range, Scale scale,
             int wanted) {
  return range ? axis_within(*range, wanted, scale) : axis_for(extent(panel, numbers, scale), wanted, scale);
}

constexpr const char* grid = "stroke=\"#e6e6e6\" stroke-width=\"1\"";
constexpr const char* frame = "stroke=\"#1a1a1a\" stroke-width=\"1\"";

double across(const Axis& axis, double value, const Box& box) {
  return box.left + axis.share(value) * (box.right - box.left);
}
double up(const Axis& axis, double value, const Box& box) {
  return box.bottom + axis.share(value) * (box.top - box.bottom);
}

std::string x_axis(const Axis& axis, const Box& box) {
  std::string svg;
  for (const Axis::Tick& tick : axis.ticks) {
    const double x = across(axis, tick.value, box);
    svg += line({x, box.top}, {x, box.bottom}, grid) + line({x, box.bottom}, {x, box.bottom + 4}, frame);
    svg += text({x, box.bottom + 18}, tick.label, "text-anchor=\"middle\"");
  }
  return svg;
}

std::string y_axis(const Axis& axis, const Box& box) {
  std::string svg;
  for (const Axis::Tick& tick : axis.ticks) {
    const double y = up(axis, tick.value, box);
    svg += line({box.left, y}, {box.right, y}, grid) + line({box.left - 4, y}, {box.left, y}, frame);
    svg += text({box.left - 8, y + 4}, tick.label, "text-anchor=\"end\"");
  }
  return svg;
}

std::string labels(const Panel& panel, const Box& box) {
  const double x = box.left - margin.left + 17;
  const double y = (box.top + box.bottom) / 2;
  const std::string upright = fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 {:.1f} {:.1f})\"", x, y);
  return text({box.left, box.top - 9}, panel.title, "font-weight=\"bold\"") +
         text({(box.left + box.right) / 2, box.bottom + 36}, panel.x_label, "text-anchor=\"middle\"") +
         text({x, y}, panel.y_label, upright.c_str());
}

// Points of one column of the print, half a point wide, are the line between their extremes.
std::vector<Point> thinned(const std::vector<Point>& points) {
  constexpr std::size_t few = 1500;
  constexpr double column = 0.5;
  if (points.size() < few) return points;
  std::vector<Point> kept;
  for (std::size_t i = 0; i < points.size();) {
    std::size_t end = i, lowest = i, highest = i;
    for (; end < points.size() && std::abs(points[end].x - points[i].x) < column; ++end) {
      if (points[end].y < points[lowest].y) lowest = end;
      if (points[end].y > points[highest].y) highest = end;
    }
    kept.push_back(points[std::min(lowest, highest)]);
    if (lowest != highest) kept.push_back(points[std::max(lowest, highest)]);
    i = end;
  }
  return kept;
}

double distance(const Point& p, const Point& from, const Point& to) {
  const double x = to.x - from.x, y = to.y - from.y, length = std::hypot(x, y);
  if (!(length > 0)) return std::hypot(p.x - from.x, p.y - from.y);
  return std::abs(x * (p.y - from.y) - y * (p.x - from.x)) / length;
}

// Douglas & Peucker 1973: without the points that lie on the line through the others, to a quarter of a point.
std::vector<Point> straightened(const std::vector<Point>& points) {
  constexpr double unseen = 0.25;
  if (points.size() < 3) return points;
  std::vector<bool> kept(points.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> stretches = {{0, points.size() - 1}};
  while (!stretches.empty()) {
    const auto [first, last] = stretches.back();
    stretches.pop_back();
    std::size_t furthest = first;
    double most = unseen;
    for (std::size_t i = first + 1; i < last; ++i)
      if (const double off = distance(points[i], points[first], points[last]); off > most) most = off, furthest = i;
    if (furthest == first) continue;
    kept[furthest] = true;
    stretches.push_back({first, furthest});
    stretches.push_back({furthest, last});
  }
  std::vector<Point> left;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept[i]) left.push_back(points[i]);
  return left;
}

// Those that the panel's range shows, and the next on either side. Markers stand for values and all stay.
std::vector<Point> placed(const Curve& curve, const Panel& panel, const Axis& x, const Axis& y, const Box& box) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const bool is_shown = shows(panel.x_range, curve.x[i]) || (i > 0 && shows(panel.x_range, curve.x[i - 1])) ||
                          (i + 1 < curve.x.size() && shows(panel.x_range, curve.x[i + 1]));
    if (is_shown) points.push_back({across(x, curve.x[i], box), up(y, curve.y[i], box)});
  }
  return curve.style.marker == Marker::none ? straightened(thinned(points)) : points;
}

// Curves do not leave a panel whose range is given.
std::string clipped(const std::string& svg, const Panel& panel, const Box& box) {
  if (!panel.x_range && !panel.y_range) return svg;
  return fmt::format(
      "<svg x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\" viewBox=\"{0:.1f} {1:.1f} {2:.1f} "
      "{3:.1f}\">\n{4}</svg>\n",
      box.left, box.top, box.right - box.left, box.bottom - box.top, svg);
}

std::string drawn(const Panel& panel, const Box& box) {
  const Axis x = axis_of(panel, &Curve::x, panel.x_range, panel.x_scale, panel.wide ? 9 : 4);
  const Axis y = axis_of(panel, &Curve::y, panel.y_range, panel.y_scale, 4);
  std::string svg = x_axis(x, box) + y_axis(y, box) + line({box.left, box.top}, {box.left, box.bottom}, frame) +
                    line({box.left, box.bottom}, {box.right, box.bottom}, frame);
  if (y.scale == Scale::linear && y.low < 0 && y.high > 0) {
    const double zero = up(y, 0, box);
    svg += line({box.left, zero}, {box.right, zero}, "stroke=\"#9a9a9a\" stroke-width=\"1\"");
  }
  std::string curves;
  for (const Curve& curve : panel.curves) curves += drawn(curve.style, placed(curve, panel, x, y, box));
  return svg + clipped(curves, panel, box) + labels(panel, box);
}

struct Entry {
  const Curve* curve;
  double x, y;
};

double length_of(const std::string& name) {
  constexpr double letter = 6.4;  // its mean width at this size
  const auto begins_a_letter = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  return letter * double(std::count_if(name.begin(), name.end(), begins_a_letter));
}

// One entry for each name, in order of appearance, in as many lines as it takes.
std::vector<Entry> legend_entries(const Figure& figure) {
  std::vector<Entry> entries;
  double x = margin.left, y = 42;
  for (const Panel& panel : figure.panels)
    for (const Curve& curve : panel.curves) {
      const auto is_named_so = [&](const Entry& entry) { return entry.curve->label() == curve.label(); };
      if (curve.name.empty() || std::any_of(entries.begin(), entries.end(), is_named_so)) continue;
      const double width = 36 + length_of(curve.label()) + 26;
      if (x > margin.left && x + width - 26 > page_width - margin.right) x = margin.left, y += legend_line;
      entries.push_back({&curve, x, y});
      x += width;
    }
  return entries;
}

std::string legend(const std::vector<Entry>& entries) {
  std::string svg;
  for (const auto& [curve, x, y] : entries)
    svg += drawn(curve->style, {{x, y - 4}, {x + 14, y - 4}, {x + 28, y - 4}}) + text({x + 36, y}, curve->label());
  return svg;
}

// Where each panel lies, and where the last row ends.
std::vector<Box> places(const Figure& figure, double heading, double& end) {
  std::vector<Box> boxes;
  double top = heading;
  bool right = false;  // the next narrow panel goes to the right
  for (const Panel& panel : figure.panels) {
    if (panel.wide && right) top += row_height, right = false;
    const double left = right ? page_width / 2 : 0;
    const double width = panel.wide ? page_width : page_width / 2;
    boxes.push_back(
        {left + margin.left, top + margin.top, left + width - margin.right, top + row_height - margin.bottom});
    if (panel.wide || right) top += row_height;
    right = !panel.wide && !right;
  }
  end = right ? top + row_height : top;
  return boxes;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return safe;
}

std::string to_svg(const Figure& figure) {
  const std::vector<Entry> entries = legend_entries(figure);
  const double heading = (entries.empty() ? 28 : entries.back().y) + 20;
  double panels_end = heading;
  const std::vector<Box> boxes = places(figure, heading, panels_end);
  const double height = panels_end + caption_line * double(figure.caption.size()) + 8;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"180mm\" height=\"{:.1f}mm\" viewBox=\"0 0 {} {}\" "
      "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#1a1a1a\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      height / 4, page_width, height);
  svg += text({margin.left, 20}, figure.title, "font-weight=\"bold\" font-size=\"15\"") + legend(entries);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) svg += drawn(figure.panels[i], boxes[i]);
  for (std::size_t i = 0; i < figure.caption.size(); ++i)
    svg += text({margin.left, panels_end + 10 + caption_line * double(i)}, figure.caption[i],
                "font-size=\"12\" fill=\"#444\"");
  return svg + "</svg>\n";
}

}  // namespace dashpot::paper
