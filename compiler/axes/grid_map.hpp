// A map given by its values over uniform knots: bicubic in each cell, once continuously differentiable, through all
// values, and beyond the knots linear in each coordinate on its own.
//
// Slopes at knots are those of the polynomial through the nearest five knots of the row or column (of all, where there
// are fewer). So cubics are met exactly; a map whose fourth derivatives stay below A (in x) and B (in y) [1/m³] is
// missed by (hx⁴ A + hy⁴ B)/384 between the knots, and by an amount of fifth order in the spacings hx, hy.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "axes/sloped.hpp"

namespace dashpot::compiler::axes {

// What a map is at a point.
template <typename S>
struct Depth {
  S value;           // w [m]
  Pair<S> gradient;  // ∂w/∂x [1]
};

// Over a cell, with s and t the distances from its corner [m]: Σ coefficient[4 i + j] sⁱ tʲ.
struct BicubicCell {
  std::array<double, 16> coefficient;
};

// Cells in rows of equal y, from below; each row and each column begins and ends with one that is linear across and has
// no outer end. Cell i of a row begins at x = start[0] + (i − 1) spacing[0], but the first, which takes its s from the
// second's.
struct Grid {
  Pair<double> start;                // the first knot [m]
  Pair<double> spacing;              // [m]
  std::array<std::size_t, 2> knots;  // in x and in y, at least two
  std::vector<BicubicCell> cell;     // (knots[0] + 1) (knots[1] + 1)

  std::size_t columns() const { return knots[0] + 1; }
};

// `values[row][column]` at x = start[0] + column·spacing[0], y = start[1] + row·spacing[1]; at least two each way.
Grid grid_map(const Pair<double>& start, const Pair<double>& spacing, const std::vector<std::vector<double>>& values);

// Which cell a point lies in along one axis, 0 … knots, and the knot that its s or t is measured from.
constexpr std::size_t first_knot(std::size_t place) { return place == 0 ? 0 : place - 1; }
std::size_t place(const Grid& grid, std::size_t axis, double x);
double corner(const Grid& grid, std::size_t axis, std::size_t place);

// With the coefficients of one cell, at s and t: what a law computes once it has looked them up.
template <typename S>
Depth<S> bicubic(const std::array<S, 16>& c, const S& s, const S& t) {
  std::array<S, 4> row{c[0], c[4], c[8], c[12]}, slope{c[1], c[5], c[9], c[13]};
  for (std::size_t i = 0; i < 4; ++i) {
    const S *const from = &c[4 * i], end = t * from[3], bent = t * (from[2] + end);
    row[i] = from[0] + t * (from[1] + bent);
    slope[i] = from[1] + (bent + bent) + square(t) * from[3];
  }
  const S last = s * row[3], bent = s * (row[2] + last);
  return {row[0] + s * (row[1] + bent),
          {row[1] + (bent + bent) + square(s) * row[3], slope[0] + s * (slope[1] + s * (slope[2] + s * slope[3]))}};
}

Depth<double> depth(const Grid& grid, const Pair<double>& x);
Depth<Interval> depth(const Grid& grid, const Pair<Interval>& x);
Symmetric<double> bend(const Grid& grid, const Pair<double>& x);
Symmetric<Interval> bend(const Grid& grid, const Pair<Interval>& x);
Depth<Sloped> depth(const Grid& grid, const Pair<Sloped>& x);
Symmetric<Sloped> bend(const Grid& grid, const Pair<Sloped>& x);

}  // namespace dashpot::compiler::axes
