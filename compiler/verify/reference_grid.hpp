// A map given over a grid, in 100 digits, by code that shares no formula with axes/grid_map.hpp: derivatives at the
// knots by Newton's divided differences through the five nearest, and Hermite's four basis functions between knots.
#pragma once

#include <array>
#include <vector>

#include "axes/grid_map.hpp"
#include "verify/reference_form.hpp"

namespace dashpot::compiler {

class ReferenceGrid {
 public:
  explicit ReferenceGrid(const axes::Grid& grid);

  // Where the tip is at (x, y) [m].
  Reference depth(const Reference& x, const Reference& y) const;

 private:
  using Row = std::vector<Reference>;
  using Rows = std::vector<Row>;

  // Where along an axis, and how far from there in steps of the grid.
  struct Place {
    std::size_t knot;
    Reference within;
    bool is_inside;
  };

  static Row slopes(const Row& values);
  static Rows slopes_across(const Rows& rows);
  static Rows turned(const Rows& rows);
  static Reference between(const Place& place, const Reference& begin, const Reference& end,
                           const Reference& slope_at_begin, const Reference& slope_at_end);
  Place place(std::size_t axis, const Reference& at) const;

  std::array<Reference, 2> start_, step_;
  Rows value_, by_x_, by_y_, by_xy_;  // [row][column], derivatives by steps of the grid
};

}  // namespace dashpot::compiler
