// Enclosed symmetric matrices over the joints, weighed against W = diag(weight).
#pragma once

#include <limits>

#include "axes/sloped.hpp"

namespace dashpot::compiler::axes {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

// The largest x over the members N of an interval matrix with x W ≥ N is at a corner, where the diagonal is largest and
// the coupling farthest from 0:
//
//     x = ½(a + c) + √(¼(a − c)² + b²),     a = N11/W1, c = N22/W2, b² = N12²/(W1 W2)
//
// x is convex in the matrix. So over a box it is largest with every t_j at an end, if the entries are linear in them;
// the widths of the slopes are included in the entries there. Or, if it is less, x of the entries' own enclosures.
struct Largest {
  double x;
  Pair<double> at{0, 0};  // the first two t_j at that end
};
Largest weighed(const Symmetric<Sloped>& n, const Pair<double>& weight);

// Where in a box that is.
Pair<double> place_in(const Box& box, const Largest& largest);

// ‖N‖, the largest |λ| of N v = λ W v.
double size_of(const Symmetric<Sloped>& n, const Pair<double>& weight);

}  // namespace dashpot::compiler::axes
