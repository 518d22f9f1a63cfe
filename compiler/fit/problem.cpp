#include "fit/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dashpot::compiler::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// What the network's answer is compared with: storage above loss in a spectrum.
std::vector<double> measured(const Recording& recording, Form form) {
  if (recording.kind == RecordingKind::motion && form == Form::compliance) return recording.position;
  std::vector<double> values = recording.force;
  values.insert(values.end(), recording.loss.begin(), recording.loss.end());
  return values;
}

// Relative to each value; of a spectrum to its magnitude, for storage and loss alike.
double relative_weight(const Recording& recording, const std::vector<double>& values, std::size_t row) {
  const std::size_t count = recording.time.size();
  const double size = recording.kind == RecordingKind::frequency
                          ? std::hypot(recording.force[row % count], recording.loss[row % count])
                          : std::abs(values[row]);
  return size > 0 ? 1 / size : 0;
}

double weight_of(const Recording& recording, const std::vector<double>& values, std::size_t row, Weighting weighting) {
  if (row < recording.assumed_rows || recording.is_free(row)) return 0;
  if (weighting == Weighting::relative) return relative_weight(recording, values, row);
  if (weighting != Weighting::deviation || recording.deviation.empty()) return 1;
  const double deviation = recording.deviation[row % recording.time.size()];  // of storage and loss alike
  return deviation > 0 ? 1 / deviation : 0;
}

}  // namespace

Problem::Problem(const std::vector<Recording>& recordings, Form form, Weighting weighting, std::size_t most_rows)
    : recordings_(&recordings), form_(form) {
  find_scales();
  for (std::size_t file = 0; file < recordings.size(); ++file)
    signals_.push_back(signal_of(recordings[file], file, form, band_, {}));
  weigh(weighting, most_rows);
}

void Problem::find_scales() {
  shortest_step_ = std::numeric_limits<double>::infinity();
  for (const Recording& recording : *recordings_) {
    const std::vector<double>& time = recording.time;
    if (recording.kind == RecordingKind::frequency) {
      shortest_step_ = std::min(shortest_step_, 1 / time.back());
      duration_ = std::max(duration_, 1 / time.front());
      continue;
    }
    const bool is_history = recording.kind == RecordingKind::motion;
    duration_ = std::max(duration_, is_history ? time.back() - time.front() : time.back());
    if (!is_history) shortest_step_ = std::min(shortest_step_, time.front() > 0 ? time.front() : time[1]);
    for (std::size_t i = 1 + recording.assumed_rows; is_history && i < time.size(); ++i)
      shortest_step_ = std::min(shortest_step_, time[i] - time[i - 1]);
    for (const double position : recording.position) largest_reach_ = std::max(largest_reach_, std::abs(position));
  }
  band_ = {0.1 / duration_, 10 / shortest_step_};
}

double Problem::curve_reach() const {
  if (largest_reach_ == 0) return 0;
  const double step = std::pow(10, std::floor(std::log10(largest_reach_)) - 2);
  return std::ceil(largest_reach_ / step * (1 - 1e-12)) * step;
}

void Problem::weigh(Weighting weighting, std::size_t most_rows) {
  std::vector<double> target, weights;
  for (const Recording& recording : *recordings_) {
    const std::vector<double> values = measured(recording, form_);
    const std::size_t stride = std::max<std::size_t>(1, (values.size() + most_rows - 1) / most_rows);
    blocks_.push_back({static_cast<Index>(target.size()), 0});
    kept_.emplace_back();
    for (std::size_t row = 0; row < values.size(); row += stride) {
      const double weight = weight_of(recording, values, row, weighting);
      kept_.back().push_back(static_cast<Index>(row));
      weights.push_back(weight);
      target.push_back(weight * values[row]);
      if (weight > 0) ++weighed_rows_;
    }
    blocks_.back().count = static_cast<Index>(target.size()) - blocks_.back().begin;
  }
  target_ = Eigen::Map<VectorXd>(target.data(), static_cast<Index>(target.size()));
  weights_ = Eigen::Map<VectorXd>(weights.data(), static_cast<Index>(weights.size()));
}

const std::vector<Signal>& Problem::signals(const std::optional<CurveShape>& curve) const {
  if (!curve) return signals_;
  if (curve_ != curve) {
    behind_curve_.clear();
    for (std::size_t file = 0; file < signals_.size(); ++file)
      behind_curve_.push_back(signal_of((*recordings_)[file], file, form_, band_, curve));
    curve_ = curve;
  }
  return behind_curve_;
}

template <class OfSignal>
VectorXd Problem::gathered(const std::optional<CurveShape>& curve, OfSignal of_signal) const {
  const std::vector<Signal>& signals = this->signals(curve);
  VectorXd column(target_.size());
  Index row = 0;
  for (std::size_t file = 0; file < signals.size(); ++file) {
    if (kept_[file].empty()) continue;
    const VectorXd whole = of_signal(signals[file]);
    for (const Index kept : kept_[file]) column[row++] = whole[kept];
  }
  return column.cwiseProduct(weights_);
}

VectorXd Problem::column(const Term& term, const std::optional<CurveShape>& curve) const {
  return gathered(curve, [&](const Signal& signal) { return unit_column(signal, term); });
}

VectorXd Problem::slope(const Term& term, Shape shape, const std::optional<CurveShape>& curve) const {
  return gathered(curve, [&](const Signal& signal) { return column_slope(signal, term, shape); });
}

MatrixXd Problem::columns(const std::vector<Term>& terms, const std::optional<CurveShape>& curve) const {
  MatrixXd matrix(target_.size(), static_cast<Index>(terms.size()));
  for (std::size_t j = 0; j < terms.size(); ++j) matrix.col(static_cast<Index>(j)) = column(terms[j], curve);
  return matrix;
}

Problem Problem::without(std::size_t file) const {
  Problem rest = *this;
  const Block gone = blocks_[file];
  const Index behind = gone.begin + gone.count, total = target_.size();
  const auto cut = [&](const VectorXd& values) {
    VectorXd kept(total - gone.count);
    kept << values.head(gone.begin), values.tail(total - behind);
    return kept;
  };
  rest.target_ = cut(target_);
  rest.weights_ = cut(weights_);
  rest.kept_[file].clear();
  rest.blocks_[file].count = 0;
  for (std::size_t later = file + 1; later < blocks_.size(); ++later) rest.blocks_[later].begin -= gone.count;
  rest.weighed_rows_ = static_cast<double>((rest.weights_.array() > 0).count());
  return rest;
}

Problem Problem::with_target(VectorXd target) const {
  Problem other = *this;
  other.target_ = std::move(target);
  return other;
}

std::size_t Model::count(TermKind kind) const {
  return static_cast<std::size_t>(
      std::count_if(terms.begin(), terms.end(), [&](const Term& term) { return term.kind == kind; }));
}

MatrixXd model_columns(const Problem& problem, const Model& model) {
  MatrixXd columns = problem.columns(model.terms, model.curve);
  for (std::size_t file = 0; file < model.gains.size(); ++file)
    if (model.gains[file] != 1)
      columns.middleRows(problem.blocks()[file].begin, problem.blocks()[file].count) *= model.gains[file];
  return columns;
}

VectorXd residual(const Problem& problem, const Model& model) {
  return problem.target() - model_columns(problem, model) * model.weights;
}

std::size_t parameter_count(const Model& model, bool gains_are_free) {
  std::size_t count = gains_are_free ? model.gains.size() - 1 : 0;
  if (model.curve) count += model.curve->parameters().size();
  for (std::size_t j = 0; j < model.terms.size(); ++j)
    if (model.weight(j) != 0) count += 1 + shape_count(model.terms[j]);
  return count;
}

std::vector<bool> signed_terms(const std::vector<Term>& terms) {
  std::vector<bool> either;
  for (const Term& term : terms) either.push_back(is_signed(term));
  return either;
}

}  // namespace dashpot::compiler::fitting
