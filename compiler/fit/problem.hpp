// Recordings stacked as the rows of one least-squares problem.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fit/unit_column.hpp"

namespace dashpot::compiler::fitting {

enum class Weighting {
  uniform,    // every row counts alike
  relative,   // by 1/|value|; of a spectrum by 1/|D(jω)|
  deviation,  // by one over the deviation that was measured
};

// The rows of one recording.
struct Block {
  Eigen::Index begin;
  Eigen::Index count;
};

class Problem {
 public:
  // Where a recording has more than `most_rows` rows, evenly many of them are weighed; the columns still follow all.
  Problem(const std::vector<Recording>& recordings, Form form, Weighting weighting, std::size_t most_rows);

  const std::vector<Recording>& recordings() const { return *recordings_; }
  const Signal& signal(std::size_t file, const std::optional<CurveShape>& curve = {}) const {
    return signals(curve)[file];
  }
  Form form() const { return form_; }
  std::size_t files() const { return signals_.size(); }
  const std::vector<Block>& blocks() const { return blocks_; }
  Eigen::Index rows() const { return target_.size(); }
  double weighed_rows() const { return weighed_rows_; }  // those that carry weight

  // Each row times its weight.
  const Eigen::VectorXd& target() const { return target_; }
  const Eigen::VectorXd& weights() const { return weights_; }
  // With a curve, of terms that lie behind it.
  Eigen::VectorXd column(const Term& term, const std::optional<CurveShape>& curve = {}) const;
  Eigen::VectorXd slope(const Term& term, Shape shape, const std::optional<CurveShape>& curve = {}) const;
  Eigen::MatrixXd columns(const std::vector<Term>& terms, const std::optional<CurveShape>& curve = {}) const;

  // Without the rows of one file.
  Problem without(std::size_t file) const;
  // With other measurements, weighted.
  Problem with_target(Eigen::VectorXd target) const;

  double shortest_step() const { return shortest_step_; }  // [s]
  double duration() const { return duration_; }            // of the longest recording [s]
  double largest_reach() const { return largest_reach_; }  // of a position from rest [m]
  double curve_reach() const;                              // the same, in three digits and not below [m]
  Band band() const { return band_; }

 private:
  const std::vector<Signal>& signals(const std::optional<CurveShape>& curve) const;
  template <class OfSignal>
  Eigen::VectorXd gathered(const std::optional<CurveShape>& curve, OfSignal of_signal) const;
  void find_scales();
  void weigh(Weighting weighting, std::size_t most_rows);

  const std::vector<Recording>* recordings_;
  Form form_;
  std::vector<Signal> signals_;
  // Behind the curve that was asked for last: many columns are of one curve.
  mutable std::optional<CurveShape> curve_;
  mutable std::vector<Signal> behind_curve_;
  std::vector<std::vector<Eigen::Index>> kept_;  // rows of each file
  std::vector<Block> blocks_;
  Eigen::VectorXd target_, weights_;
  double weighed_rows_ = 0;
  double shortest_step_ = 0, duration_ = 0, largest_reach_ = 0;
  Band band_{1, 1};
};

// Terms with their weights: a network, as far as it has been fitted.
struct Model {
  std::vector<Term> terms;
  Eigen::VectorXd weights;    // one a term; spring [N/m], damper [N·s/m], Maxwell branch and stop [N/m], offset [N]
  std::vector<double> gains;  // of each file's force sensor; 1 unless they are fitted
  double residual_sum = 0;    // of the weighted rows
  std::optional<CurveShape> curve = {};  // behind which the terms lie; only of motions

  double& weight(std::size_t term) { return weights[static_cast<Eigen::Index>(term)]; }
  double weight(std::size_t term) const { return weights[static_cast<Eigen::Index>(term)]; }
  std::size_t count(TermKind kind) const;
  std::size_t slip_count() const { return count(TermKind::stop) + count(TermKind::sliding); }
};

// Weighted columns of a model's terms, each file's times its gain.
Eigen::MatrixXd model_columns(const Problem& problem, const Model& model);
// target − model, weighted.
Eigen::VectorXd residual(const Problem& problem, const Model& model);

// Numbers that were chosen by the data: weights above zero, times, thresholds, exponents, a curve's parameters, gains
// but one.
std::size_t parameter_count(const Model& model, bool gains_are_free);

std::vector<bool> signed_terms(const std::vector<Term>& terms);

}  // namespace dashpot::compiler::fitting
