#include "fit/criterion.hpp"

#include <algorithm>
#include <cmath>

namespace dashpot::compiler::fitting {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Used if there are that many rows: a spectrum whose storage and loss disagree would otherwise count as 3.
constexpr double least_effective = 12;

// The residuals, in runs of consecutive rows.
std::vector<VectorXd> runs(const Problem& problem, const Model& model) {
  const VectorXd left = residual(problem, model);
  std::vector<VectorXd> list;
  for (std::size_t file = 0; file < problem.files(); ++file) {
    const Block& block = problem.blocks()[file];
    const Recording& recording = problem.recordings()[file];
    if (block.count == 0) continue;
    if (recording.kind == RecordingKind::frequency) {
      list.push_back(left.segment(block.begin, block.count / 2));
      list.push_back(left.segment(block.begin + block.count / 2, block.count - block.count / 2));
      continue;
    }
    const Index assumed = std::min(block.count, static_cast<Index>(recording.assumed_rows));
    list.push_back(left.segment(block.begin + assumed, block.count - assumed));
  }
  return list;
}

double product(const std::vector<VectorXd>& runs, Index lag) {
  double sum = 0;
  for (const VectorXd& run : runs)
    if (run.size() > lag) sum += run.head(run.size() - lag).dot(run.tail(run.size() - lag));
  return sum;
}

double effective_of(const std::vector<VectorXd>& left, double count) {
  const double power = product(left, 0);
  Index longest = 0;
  for (const VectorXd& run : left) longest = std::max(longest, run.size());
  double sum = 0;  // Σ of pairs, ρ_0 = 1 in the first
  for (Index k = 0; power > 0 && 2 * k + 1 < longest; ++k) {
    const double pair = (product(left, 2 * k) + product(left, 2 * k + 1)) / power;
    if (pair <= 0) break;
    sum += pair;
  }
  const double samples_a_row = std::max(1.0, 2 * sum - 1);
  return std::max({1.0, std::min(least_effective, count), count / samples_a_row});
}

}  // namespace

double effective_samples(const Problem& problem, const Model& model) {
  return effective_of(runs(problem, model), problem.weighed_rows());
}

double effective_samples(const VectorXd& left) { return effective_of({left}, static_cast<double>(left.size())); }

double lag_one_correlation(const VectorXd& left) {
  const double power = left.squaredNorm();
  return left.size() > 1 && power > 0 ? left.head(left.size() - 1).dot(left.tail(left.size() - 1)) / power : 0;
}

double criterion(const Problem& problem, const Model& model, double effective, bool gains_are_free) {
  const double smallest = 1e-28 * problem.target().squaredNorm();  // an exact fit is as good as rounding allows
  const double mean = std::max(model.residual_sum, smallest) / problem.weighed_rows();
  return effective * std::log(mean) + static_cast<double>(parameter_count(model, gains_are_free)) * std::log(effective);
}

}  // namespace dashpot::compiler::fitting
