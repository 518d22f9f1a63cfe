#include "report/workspace_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/axis.hpp"
#include "report/markup.hpp"
#include "report/number_text.hpp"

namespace dashpot::compiler {
namespace {

using axes::Pair;

constexpr double shades = 20;
constexpr int cells_of_lines = 96;  // a side, where a curve is looked for

class MapDrawing {
 public:
  explicit MapDrawing(const WorkspaceMap& map) : map_(map) {
    const double across = map.shown[0].high - map.shown[0].low, up = map.shown[1].high - map.shown[1].low;
    scale_ = std::min(widest / across, tallest / up);
    right_ = left + scale_ * across, bottom_ = top + scale_ * up;
  }

  MapFrame frame() const { return {x_at(0), y_at(0), scale_}; }

  std::string svg() const {
    const double scale_height = map_.scale.empty() ? 0 : 40;
    std::string text = fmt::format(
        "<svg class=\"plot map\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n",
        std::max(right_, left + widest) + right_margin, bottom_ + below + scale_height, escaped(map_.title));
    text += cells() + axis(0) + axis(1);
    text += fmt::format("<path class=\"frame\" d=\"M{} {}V{:.1f}H{:.1f}\"/>\n", left, top, bottom_, right_);
    text += lines() + arrows() + dots();
    return text + (map_.scale.empty() ? "" : shade_scale()) + "</svg>\n";
  }

 private:
  static constexpr double left = 62, top = 12, below = 48, right_margin = 12;
  static constexpr double widest = 366, tallest = 330;  // of what is framed

  double x_at(double x) const { return left + scale_ * (x - map_.shown[0].low); }
  double y_at(double y) const { return bottom_ - scale_ * (y - map_.shown[1].low); }
  static double shade(double share) { return std::round(std::clamp(share, 0.0, 1.0) * shades) / shades; }
  double shade_of(const ShadedCell& cell) const { return shade(cell.level / map_.full); }

  // Neighbours in a row that look alike are one rectangle.
  std::string cells() const {
    std::string text, marks;
    const double wide = scale_ * map_.cell_size[0], high = scale_ * map_.cell_size[1];
    for (std::size_t i = 0; i < map_.cells.size();) {
      const ShadedCell& first = map_.cells[i];
      const auto goes_on = [&](std::size_t k) {
        const ShadedCell& cell = map_.cells[k];
        return std::abs(cell.centre[1] - first.centre[1]) < map_.cell_size[1] / 2 &&
               std::abs(cell.centre[0] - first.centre[0] - double(k - i) * map_.cell_size[0]) < map_.cell_size[0] / 2 &&
               shade_of(cell) == shade_of(first) && cell.is_marked == first.is_marked;
      };
      std::size_t end = i + 1;
      while (end < map_.cells.size() && goes_on(end)) ++end;
      const double x = x_at(first.centre[0]) - wide / 2, y = y_at(first.centre[1]) - high / 2;
      const double length = wide * double(end - i);
      text += fmt::format(
          "<rect class=\"shade\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
          "fill-opacity=\"{:g}\"/>\n",
          x, y, length + 0.3, high + 0.3, 0.85 * shade_of(first));
      if (first.is_marked) marks += fmt::format("M{:.1f} {:.1f}h{:.1f}v{:.1f}h{:.1f}z", x, y, length, high, -length);
      i = end;
    }
    // The page's pattern of that name.
    return marks.empty() ? text : text + "<path class=\"mark\" fill=\"url(#hatch)\" d=\"" + marks + "\"/>\n";
  }

  std::string axis(std::size_t i) const {
    const double low = 1e3 * map_.shown[i].low, high = 1e3 * map_.shown[i].high;
    const Axis ticks = linear_axis({low, high}, 5);
    std::string grid, labels;
    for (const Tick& tick : ticks.ticks) {
      if (tick.value < low - 1e-9 || tick.value > high + 1e-9) continue;
      const std::string number = fmt::format("{:g}", tick.value + 0.0);
      const std::string label = number.starts_with('-') ? "−" + number.substr(1) : number;
      if (i == 0) {
        grid += fmt::format("M{:.1f} {}V{:.1f}", x_at(1e-3 * tick.value), top, bottom_);
        labels += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x_at(1e-3 * tick.value),
                              bottom_ + 17, label);
      } else {
        grid += fmt::format("M{} {:.1f}H{:.1f}", left, y_at(1e-3 * tick.value), right_);
        labels += fmt::format("<text class=\"tick y\" x=\"{}\" y=\"{:.1f}\">{}</text>", left - 7,
                              y_at(1e-3 * tick.value) + 4, label);
      }
    }
    const double middle = (top + bottom_) / 2;
    const std::string title =
        i == 0 ? fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\">x [mm]</text>", (left + right_) / 2,
                             bottom_ + 38)
               : fmt::format(
                     "<text class=\"label\" x=\"14\" y=\"{0:.1f}\" transform=\"rotate(-90 14 {0:.1f})\">"
                     "y [mm]</text>",
                     middle);
    return "<path class=\"grid\" d=\"" + grid + "\"/>\n" + labels + title + "\n";
  }

  std::string lines() const {
    std::string text;
    for (std::size_t i = 0; i < map_.lines.size();) {
      const char* const kind = map_.lines[i].kind;
      std::string path;
      for (; i < map_.lines.size() && map_.lines[i].kind == kind; ++i)
        path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", x_at(map_.lines[i].from[0]), y_at(map_.lines[i].from[1]),
                            x_at(map_.lines[i].to[0]), y_at(map_.lines[i].to[1]));
      text += fmt::format("<path class=\"{}\" d=\"{}\"/>\n", kind, path);
    }
    return text;
  }

  std::string arrows() const {
    double longest = 0;
    for (const DrawnArrow& arrow : map_.arrows) longest = std::max(longest, std::hypot(arrow.along[0], arrow.along[1]));
    if (!(longest > 0)) return "";
    std::string path;
    for (const DrawnArrow& arrow : map_.arrows) {
      const double length = std::hypot(arrow.along[0], arrow.along[1]);
      const double drawn = scale_ * map_.longest_arrow * length / longest;
      if (drawn < 1) {
        path += fmt::format("M{:.1f} {:.1f}h0", x_at(arrow.at[0]), y_at(arrow.at[1]));
        continue;
      }
      const Pair<double> way{drawn * arrow.along[0] / length, -drawn * arrow.along[1] / length};
      const double head = std::min(5.0, drawn / 2) / drawn;
      const double x = x_at(arrow.at[0]) + way[0], y = y_at(arrow.at[1]) + way[1];
      path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", x - way[0], y - way[1], x, y);
      for (const double side : {0.5, -0.5})
        path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", x - head * (way[0] + side * way[1]),
                            y - head * (way[1] - side * way[0]), x, y);
    }
    return "<path class=\"arrow\" d=\"" + path + "\"/>\n";
  }

  std::string dots() const {
    std::string text;
    for (const NamedPlace& dot : map_.dots) {
      const double x = x_at(dot.at[0]), y = y_at(dot.at[1]);
      text += fmt::format("<circle class=\"place\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"/>", x, y);
      const bool is_right = x > (left + right_) / 2, is_up = y < top + 24;
      text +=
          fmt::format("<text class=\"label {}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", is_right ? "before" : "after",
                      x + (is_right ? -7 : 7), y + (is_up ? 16 : -7), escaped(dot.label));
    }
    return text;
  }

  std::string shade_scale() const {
    const double y = bottom_ + below + 2, length = 120;
    std::string text;
    constexpr int steps = 10;
    for (int k = 0; k < steps; ++k)
      text += fmt::format(
          "<rect class=\"shade\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"10\" "
          "fill-opacity=\"{:g}\"/>",
          left + length * k / steps, y, length / steps + 0.3, 0.85 * shade((k + 0.5) / steps));
    text += fmt::format("<rect class=\"outline\" x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"10\"/>", left, y, length);
    text += fmt::format("<text class=\"tick\" x=\"{}\" y=\"{:.1f}\">0</text>", left, y + 25);
    if (map_.full > 1.2)
      text += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\">1</text>", left + length / map_.full, y + 25);
    text += fmt::format("<text class=\"tick\" x=\"{}\" y=\"{:.1f}\">{}</text>", left + length, y + 25,
                        number_text(map_.full, 3));
    return text + fmt::format("<text class=\"label after\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left + length + 10,
                              y + 10, escaped(map_.scale));
  }

  const WorkspaceMap& map_;
  double scale_, right_, bottom_;
};

}  // namespace

MapFrame frame_of(const WorkspaceMap& map) { return MapDrawing(map).frame(); }

std::string map_figure(const WorkspaceMap& map) {
  return "<figure>\n<figcaption>" + escaped(map.title) + "</figcaption>\n" + MapDrawing(map).svg() +
         (map.note.empty() ? "" : "<p class=\"note\">" + map.note + "</p>\n") + "</figure>\n";
}

std::vector<DrawnLine> zero_lines(const axes::Box& box, const std::function<double(const Pair<double>&)>& value,
                                  const char* kind) {
  std::vector<DrawnLine> lines;
  const double wide = (box[0].high - box[0].low) / cells_of_lines, high = (box[1].high - box[1].low) / cells_of_lines;
  const auto corner = [&](int i, int k) { return Pair<double>{box[0].low + wide * i, box[1].low + high * k}; };
  for (int k = 0; k < cells_of_lines; ++k)
    for (int i = 0; i < cells_of_lines; ++i) {
      const Pair<double> corners[4] = {corner(i, k), corner(i + 1, k), corner(i + 1, k + 1), corner(i, k + 1)};
      std::vector<Pair<double>> crossings;
      for (int side = 0; side < 4; ++side) {
        const Pair<double>&from = corners[side], &to = corners[(side + 1) % 4];
        const double a = value(from), b = value(to);
        if ((a < 0) == (b < 0)) continue;
        const double share = a / (a - b);
        crossings.push_back({from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])});
      }
      for (std::size_t c = 0; c + 1 < crossings.size(); c += 2) lines.push_back({crossings[c], crossings[c + 1], kind});
    }
  return lines;
}

}  // namespace dashpot::compiler
