#include "axes/viscous_field.hpp"

#include <algorithm>

#include "axes/brakes.hpp"

namespace dashpot::compiler::axes {
namespace {

// What decimals leave of a value that is meant to be 0, as a share of the largest.
constexpr double rounding_slack = 1e-12;

double largest_of(const Matrix<double>& m) {
  return std::max({std::abs(m[0][0]), std::abs(m[0][1]), std::abs(m[1][0]), std::abs(m[1][1])});
}

std::size_t cell_along(const ViscousField& field, std::size_t axis, double way) {
  return std::min(std::size_t(way / field.spacing[axis]), cells_of(field)[axis] - 1);
}

// The part of a way from the first knot that lies in a cell, from its corner; a little wider, since corners are
// rounded.
Interval part_in_cell(const ViscousField& field, std::size_t axis, std::size_t cell, const Interval& way) {
  const double corner = double(cell) * field.spacing[axis], slack = 1e-9 * field.spacing[axis];
  return Interval{std::max(way.low, corner - slack), std::min(way.high, corner + field.spacing[axis] + slack)} -
         Interval(corner);
}

// An entry over a box, and its derivatives there.
struct Enclosed {
  Interval value, by_x, by_y;
};

Enclosed enclosed(const ViscousField& field, const Pair<Interval>& way, std::size_t i, std::size_t j) {
  std::optional<Enclosed> all;
  for (std::size_t row = cell_along(field, 1, way[1].low); row <= cell_along(field, 1, way[1].high); ++row)
    for (std::size_t column = cell_along(field, 0, way[0].low); column <= cell_along(field, 0, way[0].high); ++column) {
      const BilinearCell numbers = cell_entry(field, column, row, i, j);
      const std::array<Interval, 4> c{Interval(numbers[0]), Interval(numbers[1]), Interval(numbers[2]),
                                      Interval(numbers[3])};
      const Interval s = part_in_cell(field, 0, column, way[0]), t = part_in_cell(field, 1, row, way[1]);
      const Enclosed one{bilinear(c, s, t), c[1] + t * c[3], c[2] + s * c[3]};
      all = all ? Enclosed{hull(all->value, one.value), hull(all->by_x, one.by_x), hull(all->by_y, one.by_y)} : one;
    }
  return *all;
}

}  // namespace

bool ViscousField::is_zero() const {
  return std::all_of(at_knot.begin(), at_knot.end(), [](const auto& a) { return a == Matrix<double>{}; });
}

bool ViscousField::is_symmetric() const {
  return std::all_of(at_knot.begin(), at_knot.end(), [](const auto& a) { return a[0][1] == a[1][0]; });
}

std::array<std::size_t, 2> cells_of(const ViscousField& field) {
  return {std::max<std::size_t>(field.knots[0], 2) - 1, std::max<std::size_t>(field.knots[1], 2) - 1};
}

BilinearCell cell_entry(const ViscousField& field, std::size_t column, std::size_t row, std::size_t i, std::size_t j) {
  if (field.is_uniform()) return {field.at_knot.front()[i][j], 0, 0, 0};
  const auto at = [&](std::size_t x, std::size_t y) { return field.at_knot[y * field.knots[0] + x][i][j]; };
  const double here = at(column, row), beside = at(column + 1, row), above = at(column, row + 1);
  const double across = beside - here, up = above - here, both = at(column + 1, row + 1) - beside - up;
  const auto& [width, height] = field.spacing;
  return {here, across / width, up / height, both / (width * height)};
}

Matrix<double> field_at(const ViscousField& field, const Pair<double>& x) {
  if (field.is_uniform()) return field.at_knot.front();
  const Pair<double> way{way_from_first_knot(field, 0, x[0]), way_from_first_knot(field, 1, x[1])};
  const std::size_t column = cell_along(field, 0, way[0]), row = cell_along(field, 1, way[1]);
  const double s = way[0] - double(column) * field.spacing[0], t = way[1] - double(row) * field.spacing[1];
  Matrix<double> a;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) a[i][j] = bilinear(cell_entry(field, column, row, i, j), s, t);
  return a;
}

// Beyond the outer knots derivatives are 0, which way_from_first_knot() brings in.
Matrix<Sloped> field_at(const ViscousField& field, const Pair<Sloped>& x) {
  const Pair<Sloped> way{way_from_first_knot(field, 0, x[0]), way_from_first_knot(field, 1, x[1])};
  const Pair<Interval> over{way[0].value, way[1].value}, middle{way[0].middle, way[1].middle};
  const auto entry = [&](std::size_t i, std::size_t j) {
    if (field.is_uniform()) return Sloped(field.at_knot.front()[i][j]);
    const Enclosed there = enclosed(field, over, i, j);
    return Sloped(there.value, enclosed(field, middle, i, j).value,
                  combined(there.by_x, way[0].slope, there.by_y, way[1].slope));
  };
  return {{{entry(0, 0), entry(0, 1)}, {entry(1, 0), entry(1, 1)}}};
}

std::optional<Driving> driving(const Matrix<double>& viscous) {
  const Symmetric<double> heat = symmetric_part(viscous);
  const double least = least_eigenvalue(heat);
  if (least >= -rounding_slack * largest_of(viscous)) return std::nullopt;
  // Both are multiples of the eigenvector; the longer one is far from 0.
  const Pair<double> one{heat.xy, least - heat.xx}, other{least - heat.yy, heat.xy};
  const Pair<double>& longer = length_squared(one) > length_squared(other) ? one : other;
  const double length = std::sqrt(length_squared(longer));
  if (length == 0) return Driving{{1, 0}, -least};
  return Driving{(1 / length) * longer, -least};
}

std::optional<double> curl_in_position(const Matrix<double>& stiffness) {
  const double curl = stiffness[1][0] - stiffness[0][1];
  if (std::abs(curl) <= rounding_slack * largest_of(stiffness)) return std::nullopt;
  return curl;
}

// ω² is the mean, in logarithms, of the least and the largest d_1/d_2: then neither side of the minimum is always the
// smaller one.
double gate_ratio(const std::vector<Pair<double>>& dampings) {
  std::optional<Pair<double>> range;
  for (const auto& [p, s] : dampings) {
    if (!(p > 0 && s > 0)) continue;
    const double ratio = std::log(p / s);
    if (!range) range = {ratio, ratio};
    range = {std::min((*range)[0], ratio), std::max((*range)[1], ratio)};
  }
  return range ? std::exp(0.25 * ((*range)[0] + (*range)[1])) : 1;
}

}  // namespace dashpot::compiler::axes
