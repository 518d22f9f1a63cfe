#include "figure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "axis.hpp"

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
constexpr double heading = 62;  // title and legend
constexpr double row_height = 235;
constexpr double caption_line = 17;
constexpr Box margin{66, 26, 14, 46};  // of a panel, for title, ticks and labels
constexpr double marker_radius = 2.8;

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return safe;
}

std::string text(Point at, const std::string& words, const char* attributes = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", at.x, at.y, attributes, escaped(words));
}

std::string line(Point from, Point to, const char* attributes) {
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" {}/>\n", from.x, from.y, to.x, to.y, attributes);
}

std::string marker(const Style& style, Point at) {
  constexpr double r = marker_radius;
  if (style.marker == Marker::circle)
    return fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"white\" stroke=\"{}\" stroke-width=\"1.4\"/>\n",
                       at.x, at.y, r, style.colour);
  return fmt::format("<path d=\"M{0:.2f} {1:.2f}l{2} {2}m0 -{2}l-{2} {2}\" stroke=\"{3}\" stroke-width=\"1.3\"/>\n", at.x - r,
                     at.y - r, 2 * r, style.colour);
}

std::string polyline(const Style& style, const std::vector<Point>& points) {
  std::string path;
  for (const Point& p : points) path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", p.x, p.y);
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-dasharray=\"{}\" "
                     "stroke-linejoin=\"round\"/>\n", path,
                     style.colour, style.width, *style.dashes ? style.dashes : "none");
}

std::string drawn(const Style& style, const std::vector<Point>& points) {
  std::string svg = style.width > 0 ? polyline(style, points) : "";
  if (style.marker != Marker::none)
    for (const Point& p : points) svg += marker(style, p);
  return svg;
}

Interval extent(const Panel& panel, std::vector<double> Curve::* numbers) {
  Interval all{0, 0};  // zero is always shown: forces and motions start there
  for (const Curve& curve : panel.curves)
    for (const double value : curve.*numbers) all = {std::min(all.low, value), std::max(all.high, value)};
  return all;
}

constexpr const char* grid = "stroke=\"#e6e6e6\" stroke-width=\"1\"";
constexpr const char* frame = "stroke=\"#1a1a1a\" stroke-width=\"1\"";

std::string x_axis(const Ticks& ticks, const Box& box) {
  std::string svg;
  for (long i = ticks.first; i <= ticks.last; ++i) {
    const double x = place(ticks, double(i) * ticks.step, box.left, box.right);
    svg += line({x, box.top}, {x, box.bottom}, grid) + line({x, box.bottom}, {x, box.bottom + 4}, frame);
    svg += text({x, box.bottom + 18}, tick_label(ticks, i), "text-anchor=\"middle\"");
  }
  return svg;
}

std::string y_axis(const Ticks& ticks, const Box& box) {
  std::string svg;
  for (long i = ticks.first; i <= ticks.last; ++i) {
    const double y = place(ticks, double(i) * ticks.step, box.bottom, box.top);
    svg += line({box.left, y}, {box.right, y}, grid) + line({box.left - 4, y}, {box.left, y}, frame);
    svg += text({box.left - 8, y + 4}, tick_label(ticks, i), "text-anchor=\"end\"");
  }
  return svg;
}

std::string labels(const Panel& panel, const Box& box) {
  const double x = box.left - margin.left + 20;
  const double y = (box.top + box.bottom) / 2;
  const std::string upright = fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 {:.1f} {:.1f})\"", x, y);
  return text({box.left, box.top - 9}, panel.title, "font-weight=\"bold\"") +
         text({(box.left + box.right) / 2, box.bottom + 36}, panel.x_label, "text-anchor=\"middle\"") +
         text({x, y}, panel.y_label, upright.c_str());
}

std::string drawn(const Panel& panel, const Box& box) {
  const Ticks x = ticks_for(extent(panel, &Curve::x), 4);
  const Ticks y = ticks_for(extent(panel, &Curve::y), 4);
  std::string svg = x_axis(x, box) + y_axis(y, box) + line({box.left, box.top}, {box.left, box.bottom}, frame) +
                    line({box.left, box.bottom}, {box.right, box.bottom}, frame);
  if (y.first < 0) {
    const double zero = place(y, 0, box.bottom, box.top);
    svg += line({box.left, zero}, {box.right, zero}, "stroke=\"#9a9a9a\" stroke-width=\"1\"");
  }
  for (const Curve& curve : panel.curves) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      points.push_back({place(x, curve.x[i], box.left, box.right), place(y, curve.y[i], box.bottom, box.top)});
    svg += drawn(curve.style, points);
  }
  return svg + labels(panel, box);
}

// One entry for each name, in order of appearance.
std::string legend(const Figure& figure) {
  std::vector<std::string> seen;
  std::string svg;
  double x = margin.left;
  constexpr double y = 42;
  for (const Panel& panel : figure.panels)
    for (const Curve& curve : panel.curves) {
      if (curve.name.empty() || std::find(seen.begin(), seen.end(), curve.name) != seen.end()) continue;
      seen.push_back(curve.name);
      svg += drawn(curve.style, {{x, y - 4}, {x + 14, y - 4}, {x + 28, y - 4}}) + text({x + 36, y}, curve.name);
      x += 36 + 6.4 * double(curve.name.size()) + 26;  // the mean width of a letter at this size
    }
  return svg;
}

Box place_of(std::size_t panel) {
  const double left = page_width / 2 * double(panel % 2);
  const double top = heading + row_height * double(panel / 2);
  return {left + margin.left, top + margin.top, left + page_width / 2 - margin.right, top + row_height - margin.bottom};
}

}  // namespace

std::string to_svg(const Figure& figure) {
  const double panels_end = heading + row_height * double((figure.panels.size() + 1) / 2);
  const double height = panels_end + caption_line * double(figure.caption.size()) + 8;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"180mm\" height=\"{:.1f}mm\" viewBox=\"0 0 {} {}\" "
      "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#1a1a1a\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      height / 4, page_width, height);
  svg += text({margin.left, 20}, figure.title, "font-weight=\"bold\" font-size=\"15\"") + legend(figure);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) svg += drawn(figure.panels[i], place_of(i));
  for (std::size_t i = 0; i < figure.caption.size(); ++i)
    svg += text({margin.left, panels_end + 10 + caption_line * double(i)}, figure.caption[i], "font-size=\"12\" fill=\"#444\"");
  return svg + "</svg>\n";
}

}  // namespace dashpot::paper
