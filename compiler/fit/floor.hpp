// The least residual of every linear network, and the proof that it is one.
#pragma once

#include "fit/problem.hpp"

namespace dashpot::compiler::fitting {

struct TimeRange {
  double shortest;  // [s]
  double longest;   // [s]
};

// Relaxation times that the recordings can tell: from the shortest step, or 1 ms, to three times the longest recording.
TimeRange resolved_times(const Problem& problem);
// Of stops: from a thousandth of the largest reach to that reach [m].
TimeRange resolved_thresholds(const Problem& problem);

// Logarithmically even, both ends included, at least `per_decade` of them in each decade.
std::vector<double> even_grid(const TimeRange& range, double per_decade);

// Solves for the weights of fixed terms, which is a convex problem. Gains stay as they are given, 1 if there are none.
Model solve_weights(const Problem& problem, std::vector<Term> terms, std::vector<double> gains,
                    const std::optional<CurveShape>& curve = {});

// Gains of the files by turns with the weights, their mean held at 1.
Model solve_weights_and_gains(const Problem& problem, std::vector<Term> terms,
                              const std::optional<CurveShape>& curve = {});

// Any linear network equals a spring, a damper and Maxwell branches side by side (Foster), whose weights are the
// solution of a convex problem. So its optimum on a grid fine enough bounds every linear network from below. The
// certificate is the largest cosine between what is left and any column on a grid ten times finer: no column that is
// missing could lower the residual by more than that share.
struct Floor {
  Model model;
  double largest_cosine = 0;
  bool is_certified() const { return largest_cosine <= 1e-3; }
};
// If noise is far below the force, even with so small a cosine a time between those of the grid could lower the
// residual. So `known` holds branches of networks that were refined: the floor is below each of these.
Floor linear_floor(const Problem& problem, const std::vector<Term>& beside, bool gains_are_free, double per_decade = 8,
                   const std::vector<Term>& known = {});

// Spring and damper where the recordings can have them.
std::vector<Term> plain_terms(const Problem& problem);

}  // namespace dashpot::compiler::fitting
