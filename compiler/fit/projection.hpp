// Variable projection: times, thresholds, exponents, curves and gains improved, weights solved for inside.
#pragma once

#include "fit/problem.hpp"

namespace dashpot::compiler::fitting {

struct ProjectionLimits {
  int rounds = 60;
  double least_progress = 1e-11;  // relative, of the residual: below it the search ends
};

// A number of a model that is not a weight.
struct Unknown {
  enum class Kind { time, threshold, exponent, curve, gain };

  Kind kind;
  std::size_t index;  // of the term, of the curve's parameter, or of the file
};
std::vector<Unknown> unknowns_of(const Model& model, bool gains_are_free);

// ∂(model)/∂(unknown), weighted, with the model's weights in it: with respect to logarithms, except for exponents and a
// curve's parameters.
Eigen::VectorXd unknown_slope(const Problem& problem, const Model& model, const Unknown& unknown);

// Levenberg–Marquardt on the logarithms with Kaufman's Jacobian J = (I − QQᵀ)(∂A/∂θ)x (Kaufman 1975, BIT 15:49), steps
// of at most one, inside the resolved ranges. The residual never rises.
Model refined(const Problem& problem, Model start, bool gains_are_free, const ProjectionLimits& limits);

}  // namespace dashpot::compiler::fitting
