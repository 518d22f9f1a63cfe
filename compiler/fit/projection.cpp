#include "fit/projection.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "fit/compressed.hpp"
#include "fit/floor.hpp"
#include "fit/non_negative.hpp"

namespace dashpot::compiler::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double value_of(const Model& model, const Unknown& unknown) {
  switch (unknown.kind) {
    case Unknown::Kind::time: return model.terms[unknown.index].time;
    case Unknown::Kind::threshold: return model.terms[unknown.index].threshold;
    case Unknown::Kind::exponent: return model.terms[unknown.index].exponent;
    case Unknown::Kind::curve: return model.curve->parameters()[unknown.index];
    case Unknown::Kind::gain: break;
  }
  return model.gains[unknown.index];
}

void set_value(Model& model, const Unknown& unknown, double value) {
  switch (unknown.kind) {
    case Unknown::Kind::time: model.terms[unknown.index].time = value; return;
    case Unknown::Kind::threshold: model.terms[unknown.index].threshold = value; return;
    case Unknown::Kind::exponent: model.terms[unknown.index].exponent = value; return;
    case Unknown::Kind::curve: model.curve->set_parameter(unknown.index, value); return;
    case Unknown::Kind::gain: model.gains[unknown.index] = value; return;
  }
}

// Of one that is not searched by its logarithm.
bool is_additive(const Unknown& unknown) {
  return unknown.kind == Unknown::Kind::exponent || unknown.kind == Unknown::Kind::curve;
}

TimeRange bounds_of(const Problem& problem, const Model& model, const Unknown& unknown) {
  switch (unknown.kind) {
    case Unknown::Kind::time: {
      TimeRange range = resolved_times(problem);
      // A damper beside a slip may vanish: the slip alone is left.
      if (model.terms[unknown.index].kind == TermKind::sliding) range.shortest /= 100;
      return range;
    }
    case Unknown::Kind::threshold: return {resolved_thresholds(problem).shortest, resolved_thresholds(problem).longest};
    case Unknown::Kind::exponent: return {0.005, 0.995};
    case Unknown::Kind::curve: return {range_of(model.curve->kind()).least, range_of(model.curve->kind()).most};
    case Unknown::Kind::gain: break;
  }
  return {0.2, 5};
}

// What a branch held at the first row decays with the branch.
void move_initial_forces(Model& model, double before, double after) {
  for (Term& term : model.terms)
    if (term.kind == TermKind::initial && term.time == before) term.time = after;
}

// A linear solution at the model's present shape.
struct Linear {
  MatrixXd columns;
  VectorXd left;   // target − model
  MatrixXd basis;  // orthonormal, of the columns with weight
};

class Projection {
 public:
  Projection(const Problem& problem, Model model, bool gains_are_free)
      : problem_(problem), model_(std::move(model)), unknowns_(unknowns_of(model_, gains_are_free)) {
    for (const Unknown& unknown : unknowns_) clamp(model_, unknown);
    linear_ = solve(model_);
  }

  Model run(const ProjectionLimits& limits) {
    for (int round = 0; round < limits.rounds && !unknowns_.empty(); ++round)
      if (!improve(limits.least_progress)) break;
    normalise_gains();
    return std::move(model_);
  }

 private:
  void clamp(Model& model, const Unknown& unknown) const {
    const TimeRange range = bounds_of(problem_, model, unknown);
    set_value(model, unknown, std::clamp(value_of(model, unknown), range.shortest, range.longest));
  }

  Linear solve(Model& model) const {
    Linear linear{model_columns(problem_, model), {}, {}};
    const Compressed small = compressed(linear.columns, problem_.target());
    const NonNegativeSolution solution =
        solve_non_negative(small.columns, small.target, signed_terms(model.terms), model.weights);
    model.weights = solution.weights;
    linear.left = problem_.target() - linear.columns * model.weights;
    model.residual_sum = linear.left.squaredNorm();
    return linear;
  }

  void find_basis(Linear& linear) const {
    std::vector<Index> chosen;
    for (Index j = 0; j < model_.weights.size(); ++j)
      if (model_.weights[j] != 0) chosen.push_back(j);
    MatrixXd columns(linear.columns.rows(), static_cast<Index>(chosen.size()));
    for (std::size_t k = 0; k < chosen.size(); ++k) columns.col(static_cast<Index>(k)) = linear.columns.col(chosen[k]);
    const Eigen::HouseholderQR<MatrixXd> qr(columns);
    linear.basis = qr.householderQ() * MatrixXd::Identity(columns.rows(), std::min(columns.rows(), columns.cols()));
  }

  MatrixXd jacobian() {
    find_basis(linear_);
    MatrixXd slopes(problem_.rows(), static_cast<Index>(unknowns_.size()));
    for (std::size_t k = 0; k < unknowns_.size(); ++k)
      slopes.col(static_cast<Index>(k)) = unknown_slope(problem_, model_, unknowns_[k]);
    return slopes - linear_.basis * (linear_.basis.transpose() * slopes);
  }

  // One step down; false where none is found, or it is smaller than asked for.
  bool improve(double least_progress) {
    const MatrixXd slopes = jacobian();
    const VectorXd downhill = slopes.transpose() * linear_.left;
    MatrixXd normal = slopes.transpose() * slopes;
    const double floor = 1e-12 * std::max(normal.diagonal().maxCoeff(), 1e-300);
    for (int tried = 0; tried < 8; ++tried) {
      MatrixXd damped = normal;
      for (Index k = 0; k < damped.rows(); ++k) damped(k, k) += damping_ * std::max(normal(k, k), floor);
      const VectorXd step = damped.ldlt().solve(downhill);
      if (step.allFinite() && accept(step)) return last_progress_ > least_progress;
      damping_ = std::min(1e8, 6 * damping_);
    }
    return false;
  }

  bool accept(const VectorXd& step) {
    Model moved = model_;
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      const double change = std::clamp(step[static_cast<Index>(k)], -1.0, 1.0);
      const double before = value_of(moved, unknowns_[k]);
      set_value(moved, unknowns_[k], is_additive(unknowns_[k]) ? before + change : before * std::exp(change));
      clamp(moved, unknowns_[k]);
      if (unknowns_[k].kind == Unknown::Kind::time) move_initial_forces(moved, before, value_of(moved, unknowns_[k]));
    }
    Linear linear = solve(moved);
    if (!(moved.residual_sum < model_.residual_sum)) return false;
    last_progress_ = 1 - moved.residual_sum / model_.residual_sum;
    model_ = std::move(moved);
    linear_ = std::move(linear);
    damping_ = std::max(1e-10, damping_ / 4);
    return true;
  }

  // Gains of mean one: what they had in common belongs to the weights.
  void normalise_gains() {
    double mean = 0;
    for (const double gain : model_.gains) mean += gain / static_cast<double>(model_.gains.size());
    if (mean == 1) return;
    for (double& gain : model_.gains) gain /= mean;
    for (std::size_t j = 0; j < model_.terms.size(); ++j) model_.weight(j) *= mean;
  }

  const Problem& problem_;
  Model model_;
  std::vector<Unknown> unknowns_;
  Linear linear_;
  double damping_ = 1e-3, last_progress_ = 0;
};

// By a central difference, whose error is below the noise of any recording.
VectorXd curve_slope(const Problem& problem, const Model& model, const Unknown& unknown) {
  constexpr double reach = 1e-4;
  Model more = model, less = model;
  set_value(more, unknown, value_of(model, unknown) + reach);
  set_value(less, unknown, value_of(model, unknown) - reach);
  return (residual(problem, less) - residual(problem, more)) / (2 * reach);
}

Shape shape_of(Unknown::Kind kind) {
  return kind == Unknown::Kind::time        ? Shape::time
         : kind == Unknown::Kind::threshold ? Shape::threshold
                                            : Shape::exponent;
}

}  // namespace

std::vector<Unknown> unknowns_of(const Model& model, bool gains_are_free) {
  std::vector<Unknown> unknowns;
  for (std::size_t j = 0; j < model.terms.size(); ++j) {
    const TermKind kind = model.terms[j].kind;
    if (kind == TermKind::maxwell || kind == TermKind::sliding) unknowns.push_back({Unknown::Kind::time, j});
    if (kind == TermKind::stop || kind == TermKind::sliding) unknowns.push_back({Unknown::Kind::threshold, j});
    if (kind == TermKind::springpot) unknowns.push_back({Unknown::Kind::exponent, j});
  }
  for (std::size_t k = 0; model.curve && k < model.curve->parameters().size(); ++k)
    unknowns.push_back({Unknown::Kind::curve, k});
  // The first gain is held: a common factor is in the weights.
  for (std::size_t file = 1; gains_are_free && file < model.gains.size(); ++file)
    unknowns.push_back({Unknown::Kind::gain, file});
  return unknowns;
}

VectorXd unknown_slope(const Problem& problem, const Model& model, const Unknown& unknown) {
  VectorXd slope;
  if (unknown.kind == Unknown::Kind::gain) {
    const Block& block = problem.blocks()[unknown.index];
    slope = VectorXd::Zero(problem.rows());
    slope.segment(block.begin, block.count) =
        (problem.target() - residual(problem, model)).segment(block.begin, block.count);
    return slope;
  }
  if (unknown.kind == Unknown::Kind::curve) return curve_slope(problem, model, unknown);
  const double weight = model.weight(unknown.index);
  if (weight == 0) return VectorXd::Zero(problem.rows());
  const Term& term = model.terms[unknown.index];
  slope = weight * problem.slope(term, shape_of(unknown.kind), model.curve);
  for (std::size_t j = 0; j < model.terms.size(); ++j)
    if (unknown.kind == Unknown::Kind::time && is_initial_of(model.terms[j], term))
      slope += model.weight(j) * problem.slope(model.terms[j], Shape::time, model.curve);
  for (std::size_t file = 0; file < model.gains.size(); ++file)
    if (model.gains[file] != 1)
      slope.segment(problem.blocks()[file].begin, problem.blocks()[file].count) *= model.gains[file];
  return slope;
}

Model refined(const Problem& problem, Model start, bool gains_are_free, const ProjectionLimits& limits) {
  return Projection(problem, std::move(start), gains_are_free).run(limits);
}

}  // namespace dashpot::compiler::fitting
