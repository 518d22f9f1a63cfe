#include "verify/reference_grid.hpp"

#include <algorithm>

namespace dashpot::compiler {

// The value at a knot is the first coefficient of the cell that begins there; before the first row and column of knots
// lie cells that have none of their own.
ReferenceGrid::ReferenceGrid(const axes::Grid& grid) {
  for (std::size_t axis = 0; axis < 2; ++axis) start_[axis] = grid.start[axis], step_[axis] = grid.spacing[axis];
  for (std::size_t row = 0; row < grid.knots[1]; ++row) {
    value_.emplace_back();
    for (std::size_t column = 0; column < grid.knots[0]; ++column)
      value_.back().emplace_back(grid.cell[(row + 1) * grid.columns() + column + 1].coefficient[0]);
  }
  by_x_ = slopes_across(value_);
  by_y_ = turned(slopes_across(turned(value_)));
  by_xy_ = slopes_across(by_y_);
}

Reference ReferenceGrid::depth(const Reference& x, const Reference& y) const {
  const Place across = place(0, x), up = place(1, y);
  const auto in_row = [&](const Rows& rows, const Rows& slopes_of_rows, std::size_t row) {
    const std::size_t i = across.knot, next = across.is_inside ? i + 1 : i;
    return between(across, rows[row][i], rows[row][next], slopes_of_rows[row][i], slopes_of_rows[row][next]);
  };
  const std::size_t low = up.knot, high = up.is_inside ? low + 1 : low;
  return between(up, in_row(value_, by_x_, low), in_row(value_, by_x_, high), in_row(by_y_, by_xy_, low),
                 in_row(by_y_, by_xy_, high));
}

// The polynomial through (x_i, f_i) is f_0 + f_01 (x − x_0) + f_012 (x − x_0)(x − x_1) + …; each product's derivative
// follows with the product.
ReferenceGrid::Row ReferenceGrid::slopes(const Row& values) {
  const std::size_t count = std::min<std::size_t>(values.size(), 5);
  Row result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t first = std::min(i < count / 2 ? 0 : i - count / 2, values.size() - count);
    Row divided(values.begin() + std::ptrdiff_t(first), values.begin() + std::ptrdiff_t(first + count));
    Reference slope = 0, product = 1, rate = 0;
    for (std::size_t order = 1; order < count; ++order) {
      for (std::size_t j = count - 1; j >= order; --j)
        divided[j] = (divided[j] - divided[j - 1]) / Reference(static_cast<double>(order));
      const Reference distance = Reference(double(i)) - Reference(double(first + order - 1));
      rate = rate * distance + product;
      product *= distance;
      slope += divided[order] * rate;
    }
    result.push_back(slope);
  }
  return result;
}

ReferenceGrid::Rows ReferenceGrid::slopes_across(const Rows& rows) {
  Rows result;
  for (const Row& row : rows) result.push_back(slopes(row));
  return result;
}

ReferenceGrid::Rows ReferenceGrid::turned(const Rows& rows) {
  Rows result(rows.front().size());
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) result[i].push_back(row[i]);
  return result;
}

Reference ReferenceGrid::between(const Place& place, const Reference& begin, const Reference& end,
                                 const Reference& slope_at_begin, const Reference& slope_at_end) {
  const Reference t = place.within, rest = 1 - t;
  if (!place.is_inside) return begin + slope_at_begin * t;
  return begin * (1 + 2 * t) * rest * rest + end * t * t * (3 - 2 * t) + slope_at_begin * t * rest * rest -
         slope_at_end * t * t * rest;
}

ReferenceGrid::Place ReferenceGrid::place(std::size_t axis, const Reference& at) const {
  const std::size_t knots = axis == 0 ? value_.front().size() : value_.size();
  const Reference steps = (at - start_[axis]) / step_[axis];
  if (steps < 0) return {0, steps, false};
  if (steps >= Reference(double(knots - 1))) return {knots - 1, steps - Reference(double(knots - 1)), false};
  const auto knot = floor(steps).convert_to<std::size_t>();
  return {knot, steps - Reference(double(knot)), true};
}

}  // namespace dashpot::compiler
