// How well a model's numbers are known.
#pragma once

#include <optional>

#include "fit/problem.hpp"

namespace dashpot::compiler::fitting {

// A quantity of a written element is a product of a weight and powers of a term's shape: spring K, damper K τ, yield K
// d.
struct ElementQuantity {
  std::size_t term;
  bool times_time = false;
  bool times_threshold = false;
  bool is_inverse = false;  // of the compliance form: 1/weight
};
double value_of(const Model& model, const ElementQuantity& quantity);

// A number of the static curve that a model lies behind, above zero: its power or its rate [1/m], or its force [N] at
// the end of a stretch of a table, of the others at the reach.
struct CurveQuantity {
  enum class Kind { power, rate, force };

  Kind kind;
  double displacement = 0;  // of a force [m]
};
double value_of(const Model& model, const CurveQuantity& quantity);
std::vector<CurveQuantity> curve_quantities(const CurveShape& curve);

// The stiffness that a network's static curve is made from: of the spring from tool to ground, what slips hold then
// coming on top; or if there is none, of all springs, those of Maxwell branches and in front of slips too, and of
// springpots [N/m]; `is_instantaneous` for the latter. 0 of dampers alone, behind which no curve can be written.
struct CurveStiffness {
  double value = 0;
  bool is_instantaneous = false;
};
CurveStiffness curve_stiffness(const Model& model);

struct Interval {
  double low;
  double high;
};

// J in (ln k, ln τ, ln d) and a curve's parameters; Cov = s² (JᵀJ)⁻¹ n/n_e, s² = RSS/(n − p), with Student's t of n_e −
// p degrees of freedom. With noise whose neighbours resemble each other the ordinary formula, n_e = n, covers 29 %
// where it says 95.
class Uncertainty {
 public:
  Uncertainty(const Problem& problem, const Model& model, double effective, bool gains_are_free);

  // Fewer than p + 5 effective samples: what is left is the model's error, and no interval can be had from it.
  bool is_told() const { return is_told_; }
  // Of 95 %. Nothing for a value that is not known to a factor of a million either way.
  std::optional<Interval> interval(const ElementQuantity& quantity) const;
  std::optional<Interval> interval(const CurveQuantity& quantity) const;
  double condition() const { return condition_; }  // of J with columns of length one

 private:
  // Of what changes with the logarithms of the unknowns by these shares: half the interval.
  double reach_of(const Eigen::VectorXd& share) const;

  const Model& model_;
  Eigen::MatrixXd covariance_;
  std::vector<Eigen::Index> weight_place_, time_place_, threshold_place_;  // in the covariance; −1 where there is none
  std::vector<Eigen::Index> curve_place_;
  double quantile_ = 0;
  double condition_ = 1;
  bool is_told_ = false;
};

// The same structure fitted to all files but one, for each of them; empty for a single file.
std::vector<Model> leave_one_out(const Problem& problem, const Model& model, bool gains_are_free);

// The same structure fitted to the model plus blocks of what it leaves, drawn with replacement, each as long as it
// takes for neighbours to forget each other (Künsch 1989). Equal input gives equal draws.
std::vector<Model> block_bootstrap(const Problem& problem, const Model& model, double effective, bool gains_are_free,
                                   int draws);

// 2.5 % to 97.5 % of what the models say.
std::optional<Interval> spread(std::vector<double> values);
template <class Quantity>
std::optional<Interval> spread(const std::vector<Model>& models, const Quantity& quantity) {
  std::vector<double> values;
  for (const Model& model : models) values.push_back(value_of(model, quantity));
  return spread(std::move(values));
}

}  // namespace dashpot::compiler::fitting
