#include "fit/floor.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/compressed.hpp"
#include "fit/non_negative.hpp"

namespace dashpot::compiler::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double shortest_time = 1e-3;  // of a motion [s]: below it nothing is felt

// Each file compressed by itself, so that its gain may change.
class CompressedFiles {
 public:
  CompressedFiles(const Problem& problem, const std::vector<Term>& terms, const std::optional<CurveShape>& curve)
      : either_sign_(signed_terms(terms)) {
    const MatrixXd all = problem.columns(terms, curve);
    for (const Block& block : problem.blocks())
      files_.push_back(
          compressed(all.middleRows(block.begin, block.count), problem.target().segment(block.begin, block.count)));
  }

  NonNegativeSolution solve(const std::vector<double>& gains, const VectorXd& start = {}) const {
    Index rows = 0;
    for (const Compressed& file : files_) rows += file.columns.rows();
    MatrixXd columns(rows, static_cast<Index>(either_sign_.size()));
    VectorXd target(rows);
    Index row = 0;
    for (std::size_t i = 0; i < files_.size(); ++i) {
      columns.middleRows(row, files_[i].columns.rows()) = gains[i] * files_[i].columns;
      target.segment(row, files_[i].columns.rows()) = files_[i].target;
      row += files_[i].columns.rows();
    }
    const Compressed small = compressed(columns, target);
    return solve_non_negative(small.columns, small.target, either_sign_, start);
  }

  // ⟨f, m⟩/⟨m, m⟩ of a file's force and the model's
  double best_gain(std::size_t file, const VectorXd& weights) const {
    const VectorXd model = files_[file].columns * weights;
    const double power = model.squaredNorm();
    return power > 0 ? model.dot(files_[file].target) / power : 1;
  }

  std::size_t size() const { return files_.size(); }

 private:
  std::vector<Compressed> files_;
  std::vector<bool> either_sign_;
};

double largest_cosine(const Problem& problem, const VectorXd& left, const std::vector<double>& gains,
                      const std::vector<double>& times, double& where) {
  double largest = 0;
  const double length = left.norm();
  if (length == 0) return 0;
  for (const double time : times) {
    const Model one{{{TermKind::maxwell, time, 0, 0, 0}}, VectorXd::Ones(1), gains};
    const MatrixXd columns = model_columns(problem, one);
    const double size = columns.col(0).norm();
    const double cosine = size > 0 ? columns.col(0).dot(left) / (size * length) : 0;
    if (cosine > largest) largest = cosine, where = time;
  }
  return largest;
}

}  // namespace

TimeRange resolved_times(const Problem& problem) {
  switch (problem.recordings().front().kind) {
    case RecordingKind::motion:
      return {std::max(problem.shortest_step(), std::min(shortest_time, problem.duration())), 3 * problem.duration()};
    case RecordingKind::relaxation:
    case RecordingKind::creep: return {problem.shortest_step() / 3, 3 * problem.duration()};
    case RecordingKind::frequency: return {problem.shortest_step() / 10, 10 * problem.duration()};
  }
  return {1, 1};
}

TimeRange resolved_thresholds(const Problem& problem) {
  return {problem.largest_reach() / 1000, problem.largest_reach()};
}

std::vector<double> even_grid(const TimeRange& range, double per_decade) {
  const double decades = std::log10(range.longest / range.shortest);
  const int intervals = std::max(1, static_cast<int>(std::ceil(per_decade * decades)));
  std::vector<double> grid;
  for (int i = 0; i <= intervals; ++i)
    grid.push_back(range.shortest * std::pow(range.longest / range.shortest, double(i) / intervals));
  return grid;
}

std::vector<Term> plain_terms(const Problem& problem) {
  std::vector<Term> terms{{TermKind::spring, 0, 0, 0, 0}};
  if (problem.recordings().front().kind != RecordingKind::relaxation) terms.push_back({TermKind::damper, 0, 0, 0, 0});
  return terms;
}

Model solve_weights(const Problem& problem, std::vector<Term> terms, std::vector<double> gains,
                    const std::optional<CurveShape>& curve) {
  if (gains.empty()) gains.assign(problem.files(), 1.0);
  const NonNegativeSolution solution = CompressedFiles(problem, terms, curve).solve(gains);
  return {std::move(terms), solution.weights, std::move(gains), solution.residual_sum, curve};
}

Model solve_weights_and_gains(const Problem& problem, std::vector<Term> terms, const std::optional<CurveShape>& curve) {
  const CompressedFiles files(problem, terms, curve);
  std::vector<double> gains(files.size(), 1.0);
  NonNegativeSolution solution = files.solve(gains);
  for (int turn = 0; turn < 100; ++turn) {
    for (std::size_t i = 0; i < files.size(); ++i) gains[i] = files.best_gain(i, solution.weights);
    const double mean = std::accumulate(gains.begin(), gains.end(), 0.0) / static_cast<double>(gains.size());
    for (double& gain : gains) gain /= mean;
    const double before = solution.residual_sum;
    solution = files.solve(gains, solution.weights);
    if (before - solution.residual_sum <= 1e-9 * before) break;
  }
  return {std::move(terms), solution.weights, std::move(gains), solution.residual_sum, curve};
}

Floor linear_floor(const Problem& problem, const std::vector<Term>& beside, bool gains_are_free, double per_decade,
                   const std::vector<Term>& known) {
  const TimeRange range = resolved_times(problem);
  std::vector<Term> terms = plain_terms(problem);
  terms.insert(terms.end(), beside.begin(), beside.end());
  for (const double time : even_grid(range, per_decade)) terms.push_back({TermKind::maxwell, time, 0, 0, 0});
  terms.insert(terms.end(), known.begin(), known.end());
  const std::vector<double> finer = even_grid(range, 10 * per_decade);
  Floor floor;
  // A column that is missed is added: a few rounds do, since neighbours on the grid are nearly alike.
  for (int round = 0; round < 6; ++round) {
    floor.model = gains_are_free ? solve_weights_and_gains(problem, terms) : solve_weights(problem, terms, {});
    double missed = 0;
    floor.largest_cosine = largest_cosine(problem, residual(problem, floor.model), floor.model.gains, finer, missed);
    if (floor.is_certified() || floor.model.residual_sum <= 1e-24 * problem.target().squaredNorm()) break;
    terms.push_back({TermKind::maxwell, missed, 0, 0, 0});
  }
  return floor;
}

}  // namespace dashpot::compiler::fitting
