#include <limits>
#include <optional>
#include <utility>

#include "axes/grid_map.hpp"

namespace dashpot::compiler::axes {
namespace {

template <typename S, std::size_t... I>
std::array<S, 16> constants(const BicubicCell& cell, std::index_sequence<I...>) {
  return {S(cell.coefficient[I])...};
}

template <typename S>
std::array<S, 16> constants(const BicubicCell& cell) {
  return constants<S>(cell, std::make_index_sequence<16>());
}

// Second derivatives of a cell.
template <typename S>
Symmetric<S> bicubic_bend(const std::array<S, 16>& c, const S& s, const S& t) {
  const auto row = [&](std::size_t i) { return c[4 * i] + t * (c[4 * i + 1] + t * (c[4 * i + 2] + t * c[4 * i + 3])); };
  const auto slope = [&](std::size_t i) {
    return c[4 * i + 1] + t * (S(2) * c[4 * i + 2] + t * (S(3) * c[4 * i + 3]));
  };
  const auto bent = [&](std::size_t i) { return S(2) * c[4 * i + 2] + S(6) * t * c[4 * i + 3]; };
  return {S(2) * row(2) + S(6) * s * row(3), slope(1) + s * (S(2) * slope(2) + S(3) * s * slope(3)),
          bent(0) + s * (bent(1) + s * (bent(2) + s * bent(3)))};
}

const BicubicCell& cell_at(const Grid& grid, std::size_t column, std::size_t row) {
  return grid.cell[row * grid.columns() + column];
}

// The part of an interval that lies in a cell, or beyond the outer knots, along an axis, from the cell's corner.
Interval within(const Grid& grid, std::size_t axis, std::size_t place, const Interval& x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double from = corner(grid, axis, place), slack = 1e-9 * grid.spacing[axis];
  const double low = place == 0 ? -infinity : from - slack;
  const double high = place == 0                  ? from + slack
                      : place == grid.knots[axis] ? infinity
                                                  : from + grid.spacing[axis] + slack;
  return Interval{std::max(x.low, low), std::min(x.high, high)} - Interval(from);
}

// Calls with each cell that a box meets, and s and t in it.
template <typename Visit>
void each_cell(const Grid& grid, const Pair<Interval>& x, Visit&& visit) {
  for (std::size_t row = place(grid, 1, x[1].low); row <= place(grid, 1, x[1].high); ++row) {
    for (std::size_t column = place(grid, 0, x[0].low); column <= place(grid, 0, x[0].high); ++column) {
      visit(constants<Interval>(cell_at(grid, column, row)), within(grid, 0, column, x[0]), within(grid, 1, row, x[1]));
    }
  }
}

}  // namespace

std::size_t place(const Grid& grid, std::size_t axis, double x) {
  const double cells = std::floor((x - grid.start[axis]) / grid.spacing[axis]) + 1;
  return std::size_t(std::clamp(cells, 0.0, double(grid.knots[axis])));
}

double corner(const Grid& grid, std::size_t axis, std::size_t place) {
  return grid.start[axis] + double(first_knot(place)) * grid.spacing[axis];
}

Depth<double> depth(const Grid& grid, const Pair<double>& x) {
  const std::size_t column = place(grid, 0, x[0]), row = place(grid, 1, x[1]);
  return bicubic(cell_at(grid, column, row).coefficient, x[0] - corner(grid, 0, column), x[1] - corner(grid, 1, row));
}

Symmetric<double> bend(const Grid& grid, const Pair<double>& x) {
  const std::size_t column = place(grid, 0, x[0]), row = place(grid, 1, x[1]);
  return bicubic_bend(cell_at(grid, column, row).coefficient, x[0] - corner(grid, 0, column),
                      x[1] - corner(grid, 1, row));
}

Depth<Interval> depth(const Grid& grid, const Pair<Interval>& x) {
  std::optional<Depth<Interval>> all;
  each_cell(grid, x, [&](const std::array<Interval, 16>& c, const Interval& s, const Interval& t) {
    const Depth<Interval> one = bicubic(c, s, t);
    all = all ? Depth<Interval>{hull(all->value, one.value),
                                {hull(all->gradient[0], one.gradient[0]), hull(all->gradient[1], one.gradient[1])}}
              : one;
  });
  return *all;
}

Symmetric<Interval> bend(const Grid& grid, const Pair<Interval>& x) {
  std::optional<Symmetric<Interval>> all;
  each_cell(grid, x, [&](const std::array<Interval, 16>& c, const Interval& s, const Interval& t) {
    const Symmetric<Interval> one = bicubic_bend(c, s, t);
    all = all ? Symmetric<Interval>{hull(all->xx, one.xx), hull(all->xy, one.xy), hull(all->yy, one.yy)} : one;
  });
  return *all;
}

namespace {

// A function of x and y by its derivatives over a box.
Sloped over_box(const Interval& value, const Interval& middle, const Interval& by_x, const Interval& by_y,
                const Pair<Sloped>& x) {
  return {value, middle, combined(by_x, x[0].slope, by_y, x[1].slope)};
}

}  // namespace

Depth<Sloped> depth(const Grid& grid, const Pair<Sloped>& x) {
  const Box box{x[0].value, x[1].value}, at{x[0].middle, x[1].middle};
  const Depth<Interval> over = depth(grid, box), middle = depth(grid, at);
  const Symmetric<Interval> bends = bend(grid, box);
  return {over_box(over.value, middle.value, over.gradient[0], over.gradient[1], x),
          {over_box(over.gradient[0], middle.gradient[0], bends.xx, bends.xy, x),
           over_box(over.gradient[1], middle.gradient[1], bends.xy, bends.yy, x)}};
}

// Second derivatives jump at the cells' edges, so the bounds of all cells are joined.
Symmetric<Sloped> bend(const Grid& grid, const Pair<Sloped>& x) {
  const Box box{x[0].value, x[1].value};
  const std::size_t column = place(grid, 0, box[0].low), row = place(grid, 1, box[1].low);
  if (column == place(grid, 0, box[0].high) && row == place(grid, 1, box[1].high)) {
    return bicubic_bend(constants<Sloped>(cell_at(grid, column, row)), x[0] - Sloped(corner(grid, 0, column)),
                        x[1] - Sloped(corner(grid, 1, row)));
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Interval all(-infinity, infinity);
  const Slopes any{all, all, all, all};
  const Symmetric<Interval> over = bend(grid, box);
  return {{over.xx, over.xx, any}, {over.xy, over.xy, any}, {over.yy, over.yy, any}};
}

}  // namespace dashpot::compiler::axes
