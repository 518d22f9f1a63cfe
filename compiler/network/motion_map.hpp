// A map w of the tool's displacement u: odd, a cubic in each of its cells, straight beyond the last.
#pragma once

#include <cstddef>
#include <vector>

namespace dashpot::compiler {

// Of a cell from x on: w = a + d (b + d (c + d e)), d = u − x.
struct MapCell {
  double a, b, c, e;
};

struct MotionMap {
  double start = 0;           // u where it begins: behind a contact its surface [m] or [rad]
  double reach = 0;           // distance from there to the end of the last cubic [m] or [rad]
  std::vector<MapCell> cell;  // of equal widths, from 0 on; the last is straight and has no end
  double stiffness = 0;       // k, the network's stiffness that the curve is made from [N/m] or [N·m/rad]
  double static_error = 0;    // of the static force, over the largest [1]
  double slope_error = 0;     // of w′, over its largest [1]
  double unsure_until = 0;    // beyond this the error of w′ is at most a hundredth of its largest [m] or [rad]

  std::size_t cubics() const { return cell.size() - 1; }
  double width() const { return reach / double(cubics()); }

  // At a distance from the start that is not negative: w and w′.
  double value_at(double distance) const;
  double tangent_at(double distance) const;

  // Over the stretch between two distances that are not negative, to rounding: a lower and an upper bound of |w′|, and
  // the largest |w″|.
  double least_tangent(double from, double to) const;
  double largest_tangent(double from, double to) const;
  double largest_curvature(double from, double to) const;
  double steepest() const { return largest_tangent(0, reach); }
};

}  // namespace dashpot::compiler
