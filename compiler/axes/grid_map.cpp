#include "axes/grid_map.hpp"

namespace dashpot::compiler::axes {
namespace {

using Four = std::array<double, 4>;
using Rows = std::vector<std::vector<double>>;

constexpr std::size_t slope_knots = 5;

// The derivative at x = at of the polynomial through values at 0, 1, 2, …: Lagrange's,
//     l_j′(at) = Π_{m ≠ at, j} (at − m)/(j − m) / (j − at) for j ≠ at,      Σ_{m ≠ at} 1/(at − m) for j = at.
double weight(std::size_t count, std::size_t at, std::size_t j) {
  double sum = 0, product = 1;
  for (std::size_t m = 0; m < count; ++m) {
    if (m != at) sum += 1 / (double(at) - double(m));
    if (m != at && m != j) product *= (double(at) - double(m)) / (double(j) - double(m));
  }
  return j == at ? sum : product / (double(j) - double(at));
}

std::vector<double> slopes(const std::vector<double>& values, double spacing) {
  const std::size_t count = std::min(values.size(), slope_knots);
  std::vector<double> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t wanted = i < count / 2 ? 0 : i - count / 2, first = std::min(wanted, values.size() - count);
    for (std::size_t j = 0; j < count; ++j) result[i] += weight(count, i - first, j) * values[first + j] / spacing;
  }
  return result;
}

Rows transposed(const Rows& rows) {
  Rows result(rows.front().size(), std::vector<double>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < rows[i].size(); ++j) result[j][i] = rows[i][j];
  }
  return result;
}

Rows slopes_of_rows(const Rows& rows, double spacing) {
  Rows result;
  for (const std::vector<double>& row : rows) result.push_back(slopes(row, spacing));
  return result;
}

// Of a cubic with values f and slopes d at both ends of a cell; of a border cell the line through its knot.
Four polynomial(bool border, double f0, double d0, double f1, double d1, double width) {
  if (border) return {f0, d0, 0, 0};
  const double secant = (f1 - f0) / width;
  return {f0, d0, (3 * secant - 2 * d0 - d1) / width, (d0 + d1 - 2 * secant) / (width * width)};
}

// Values and derivatives at the knots, each [row][column].
struct Knots {
  Rows value, in_x, in_y, in_xy;
};

BicubicCell cell_between(const Grid& grid, const Knots& knots, std::size_t column, std::size_t row) {
  const std::size_t i = first_knot(column), j = first_knot(row);
  const bool edge_x = column == 0 || column == grid.knots[0], edge_y = row == 0 || row == grid.knots[1];
  const std::size_t next_i = edge_x ? i : i + 1, next_j = edge_y ? j : j + 1;
  const auto across = [&](const Rows& f, const Rows& d, std::size_t k) {
    return polynomial(edge_x, f[k][i], d[k][i], f[k][next_i], d[k][next_i], grid.spacing[0]);
  };
  const Four low = across(knots.value, knots.in_x, j), low_slope = across(knots.in_y, knots.in_xy, j);
  const Four high = across(knots.value, knots.in_x, next_j), high_slope = across(knots.in_y, knots.in_xy, next_j);
  BicubicCell cell;
  for (std::size_t m = 0; m < 4; ++m) {
    const Four up = polynomial(edge_y, low[m], low_slope[m], high[m], high_slope[m], grid.spacing[1]);
    std::copy(up.begin(), up.end(), cell.coefficient.begin() + long(4 * m));
  }
  return cell;
}

}  // namespace

Grid grid_map(const Pair<double>& start, const Pair<double>& spacing, const Rows& values) {
  const Rows in_x = slopes_of_rows(values, spacing[0]);
  const Rows in_y = transposed(slopes_of_rows(transposed(values), spacing[1]));
  const Knots knots{values, in_x, in_y, slopes_of_rows(in_y, spacing[0])};
  Grid grid{start, spacing, {values.front().size(), values.size()}, {}};
  for (std::size_t row = 0; row <= grid.knots[1]; ++row) {
    for (std::size_t column = 0; column <= grid.knots[0]; ++column) {
      grid.cell.push_back(cell_between(grid, knots, column, row));
    }
  }
  return grid;
}

}  // namespace dashpot::compiler::axes
