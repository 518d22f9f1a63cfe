#include "fit/uncertainty.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <random>

#include "fit/compressed.hpp"
#include "fit/projection.hpp"

namespace dashpot::compiler::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Inverse of JᵀJ by the singular values of J's triangle, columns scaled to length one first.
MatrixXd inverse_normal(const MatrixXd& jacobian, double& condition) {
  const VectorXd lengths = jacobian.colwise().norm().cwiseMax(1e-300);
  const MatrixXd scaled = jacobian * lengths.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<MatrixXd> svd(compressed(scaled, VectorXd::Zero(scaled.rows())).columns, Eigen::ComputeThinV);
  const VectorXd values = svd.singularValues();
  condition = values[values.size() - 1] > 0 ? values[0] / values[values.size() - 1] : 1e300;
  const VectorXd squared = values.cwiseMax(1e-12 * values[0]).array().square().inverse();
  const MatrixXd inverse = svd.matrixV() * squared.asDiagonal() * svd.matrixV().transpose();
  return lengths.cwiseInverse().asDiagonal() * inverse * lengths.cwiseInverse().asDiagonal();
}

// A value that may be a million times smaller or greater is not known. Of values that do not matter at all the reach is
// beyond what a double holds.
std::optional<Interval> by_factor(double value, double reach) {
  static const double widest = std::log(1e6);
  if (!(reach < widest)) return std::nullopt;
  return Interval{value * std::exp(-reach), value * std::exp(reach)};
}

constexpr ProjectionLimits again{40, 1e-9};
constexpr ProjectionLimits rough{8, 1e-4};

}  // namespace

double value_of(const Model& model, const ElementQuantity& quantity) {
  const Term& term = model.terms[quantity.term];
  const double weight = model.weight(quantity.term);
  return (quantity.is_inverse ? 1 / weight : weight) * (quantity.times_time ? term.time : 1) *
         (quantity.times_threshold ? term.threshold : 1);
}

CurveStiffness curve_stiffness(const Model& model) {
  CurveStiffness at_rest, at_once{0, true};
  for (std::size_t j = 0; j < model.terms.size(); ++j) {
    switch (model.terms[j].kind) {
      case TermKind::spring: at_rest.value += model.weight(j); break;
      case TermKind::maxwell:
      case TermKind::stop:
      case TermKind::sliding:
      case TermKind::springpot: at_once.value += model.weight(j); break;
      case TermKind::damper:
      case TermKind::offset:
      case TermKind::initial: break;
    }
  }
  return at_rest.value > 0 ? at_rest : at_once;
}

double value_of(const Model& model, const CurveQuantity& quantity) {
  switch (quantity.kind) {
    case CurveQuantity::Kind::power: return model.curve->parameters()[0];
    case CurveQuantity::Kind::rate: return std::exp(model.curve->parameters()[0]) / model.curve->reach();
    case CurveQuantity::Kind::force: break;
  }
  return model.curve->force_at(quantity.displacement) * curve_stiffness(model).value;
}

std::vector<CurveQuantity> curve_quantities(const CurveShape& curve) {
  if (curve.kind() == CurveShape::Kind::table) {
    std::vector<CurveQuantity> forces;
    const std::size_t stretches = curve.parameters().size() + 1;
    for (std::size_t i = 1; i <= stretches; ++i)
      forces.push_back({CurveQuantity::Kind::force, curve.reach() * double(i) / double(stretches)});
    return forces;
  }
  const bool is_power = curve.kind() == CurveShape::Kind::power;
  return {{is_power ? CurveQuantity::Kind::power : CurveQuantity::Kind::rate, 0},
          {CurveQuantity::Kind::force, curve.reach()}};
}

Uncertainty::Uncertainty(const Problem& problem, const Model& model, double effective, bool gains_are_free)
    : model_(model),
      weight_place_(model.terms.size(), -1),
      time_place_(model.terms.size(), -1),
      threshold_place_(model.terms.size(), -1) {
  const std::vector<Unknown> unknowns = unknowns_of(model, gains_are_free);
  const MatrixXd columns = model_columns(problem, model);
  MatrixXd jacobian(problem.rows(), columns.cols() + static_cast<Index>(unknowns.size()));
  Index next = 0;
  for (std::size_t j = 0; j < model.terms.size(); ++j) {
    if (model.weight(j) == 0) continue;
    weight_place_[j] = next;
    const double scale = is_signed(model.terms[j]) ? 1 : model.weight(j);
    jacobian.col(next++) = scale * columns.col(static_cast<Index>(j));
  }
  for (const Unknown& unknown : unknowns) {
    const bool is_of_model = unknown.kind == Unknown::Kind::gain || unknown.kind == Unknown::Kind::curve;
    if (!is_of_model && model.weight(unknown.index) == 0) continue;
    if (unknown.kind == Unknown::Kind::time) time_place_[unknown.index] = next;
    if (unknown.kind == Unknown::Kind::threshold) threshold_place_[unknown.index] = next;
    if (unknown.kind == Unknown::Kind::curve) curve_place_.push_back(next);
    jacobian.col(next++) = unknown_slope(problem, model, unknown);
  }
  jacobian.conservativeResize(Eigen::NoChange, next);
  const double count = problem.weighed_rows(), parameters = static_cast<double>(next);
  if (next == 0 || count <= parameters) return;
  covariance_ = inverse_normal(jacobian, condition_) * (model.residual_sum / (count - parameters) * count / effective);
  is_told_ = effective >= parameters + 5;
  using boost::math::policies::policy, boost::math::policies::promote_double;
  using StudentsT = boost::math::students_t_distribution<double, policy<promote_double<false>>>;
  if (is_told_) quantile_ = boost::math::quantile(StudentsT(effective - parameters), 0.975);
}

double Uncertainty::reach_of(const VectorXd& share) const {
  const double variance = share.dot(covariance_ * share);
  return variance < 0 ? 0 : quantile_ * std::sqrt(variance);  // NaN of a force that is 0 whatever the numbers are
}

std::optional<Interval> Uncertainty::interval(const ElementQuantity& quantity) const {
  if (!is_told_) return std::nullopt;
  VectorXd share = VectorXd::Zero(covariance_.rows());
  const auto add = [&](Index place, double power) {
    if (place >= 0) share[place] += power;
  };
  add(weight_place_[quantity.term], quantity.is_inverse ? -1 : 1);
  if (quantity.times_time) add(time_place_[quantity.term], 1);
  if (quantity.times_threshold) add(threshold_place_[quantity.term], 1);
  const double reach = reach_of(share);
  const double value = value_of(model_, quantity);
  if (is_signed(model_.terms[quantity.term])) return Interval{value - reach, value + reach};
  return by_factor(value, reach);
}

// By its slope in every number that it depends on: the curve's parameters, and weights that make its stiffness.
std::optional<Interval> Uncertainty::interval(const CurveQuantity& quantity) const {
  if (!is_told_) return std::nullopt;
  constexpr double reach = 1e-5;
  const double value = value_of(model_, quantity);
  VectorXd share = VectorXd::Zero(covariance_.rows());
  const auto add = [&](Index place, const auto& move) {
    Model more = model_, less = model_;
    move(more, reach);
    move(less, -reach);
    share[place] = std::log(value_of(more, quantity) / value_of(less, quantity)) / (2 * reach);
  };
  for (std::size_t k = 0; k < curve_place_.size(); ++k)
    add(curve_place_[k],
        [&](Model& model, double by) { model.curve->set_parameter(k, model.curve->parameters()[k] + by); });
  for (std::size_t j = 0; j < weight_place_.size(); ++j)
    if (weight_place_[j] >= 0) add(weight_place_[j], [&](Model& model, double by) { model.weight(j) *= std::exp(by); });
  return by_factor(value, reach_of(share));
}

std::vector<Model> leave_one_out(const Problem& problem, const Model& model, bool gains_are_free) {
  std::vector<Model> models;
  for (std::size_t file = 0; problem.files() > 1 && file < problem.files(); ++file)
    models.push_back(refined(problem.without(file), model, gains_are_free, again));
  return models;
}

std::vector<Model> block_bootstrap(const Problem& problem, const Model& model, double effective, bool gains_are_free,
                                   int draws) {
  VectorXd left = residual(problem, model);
  const VectorXd fitted = problem.target() - left;
  // The residuals are centred in each file: a mean that the model leaves would move every draw the same way.
  for (const Block& block : problem.blocks())
    if (block.count > 0)
      left.segment(block.begin, block.count).array() -= left.segment(block.begin, block.count).mean();
  const Index length = std::max<Index>(1, static_cast<Index>(std::ceil(problem.weighed_rows() / effective)));
  std::mt19937_64 random(1);
  std::vector<Model> models;
  for (int draw = 0; draw < draws; ++draw) {
    VectorXd target = fitted;
    for (const Block& block : problem.blocks()) {
      const Index size = std::min(length, block.count);
      for (Index row = 0; row < block.count; row += std::max<Index>(1, size)) {
        const Index from = static_cast<Index>(random() % static_cast<std::uint64_t>(block.count - size + 1));
        const Index count = std::min(size, block.count - row);
        target.segment(block.begin + row, count) += left.segment(block.begin + from, count);
      }
    }
    models.push_back(refined(problem.with_target(target), model, gains_are_free, rough));
  }
  return models;
}

std::optional<Interval> spread(std::vector<double> values) {
  if (values.size() < 2) return std::nullopt;
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
  };
  return values.size() < 40 ? Interval{values.front(), values.back()} : Interval{at(0.025), at(0.975)};
}

}  // namespace dashpot::compiler::fitting
