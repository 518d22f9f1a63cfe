#include "fit/non_negative.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <limits>

namespace dashpot::compiler::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

class ActiveSet {
 public:
  ActiveSet(const MatrixXd& columns, const VectorXd& target, const std::vector<bool>& either_sign,
            const VectorXd& start)
      : columns_(columns), target_(target), either_sign_(either_sign), lengths_(columns.colwise().norm()) {
    weights_ = VectorXd::Zero(columns.cols());
    for (Index j = 0; j < columns.cols(); ++j) {
      if (lengths_[j] > 0) columns_.col(j) /= lengths_[j];
      const bool is_started = start.size() > 0 && start[j] > 0;
      if (lengths_[j] == 0 || !(either_sign_[static_cast<std::size_t>(j)] || is_started)) continue;
      passive_.push_back(j);
      if (is_started) weights_[j] = start[j] * lengths_[j];
    }
    if (!passive_.empty()) move_to_optimum(false);
  }

  NonNegativeSolution solve() {
    // Each round lowers the residual for good; rounding alone can make it more than a few for each column.
    for (Index round = 0; round < 30 * (columns_.cols() + 1); ++round) {
      const VectorXd residual = target_ - columns_ * weights_;
      const Index entering = steepest(residual);
      if (entering < 0) break;
      passive_.push_back(entering);
      if (!move_to_optimum(true)) passive_.pop_back(), blocked_.push_back(entering);
      else blocked_.clear();
    }
    NonNegativeSolution solution{weights_, (target_ - columns_ * weights_).squaredNorm()};
    for (Index j = 0; j < columns_.cols(); ++j) solution.weights[j] = lengths_[j] > 0 ? weights_[j] / lengths_[j] : 0;
    return solution;
  }

 private:
  bool holds(const std::vector<Index>& set, Index j) const { return std::find(set.begin(), set.end(), j) != set.end(); }

  // The column along which the residual falls fastest; −1 at the optimum.
  Index steepest(const VectorXd& residual) const {
    const VectorXd gradient = columns_.transpose() * residual;
    double best = 1e-11 * target_.norm();
    Index found = -1;
    for (Index j = 0; j < columns_.cols(); ++j)
      if (lengths_[j] > 0 && gradient[j] > best && !holds(passive_, j) && !holds(blocked_, j))
        best = gradient[j], found = j;
    return found;
  }

  VectorXd passive_optimum() const {
    MatrixXd chosen(columns_.rows(), static_cast<Index>(passive_.size()));
    for (std::size_t k = 0; k < passive_.size(); ++k) chosen.col(static_cast<Index>(k)) = columns_.col(passive_[k]);
    return chosen.colPivHouseholderQr().solve(target_);
  }

  // False where the column that entered would get a weight of the wrong sign: rounding chose it.
  bool move_to_optimum(bool has_entered) {
    for (bool first = has_entered; !passive_.empty(); first = false) {
      const VectorXd optimum = passive_optimum();
      if (first && optimum[optimum.size() - 1] <= 0) return false;
      double share = 1;
      for (std::size_t k = 0; k < passive_.size(); ++k) {
        const double now = weights_[passive_[k]], then = optimum[static_cast<Index>(k)];
        if (!either_sign_[static_cast<std::size_t>(passive_[k])] && then <= 0)
          share = std::min(share, now / (now - then));
      }
      for (std::size_t k = 0; k < passive_.size(); ++k)
        weights_[passive_[k]] += share * (optimum[static_cast<Index>(k)] - weights_[passive_[k]]);
      if (share >= 1) return true;
      drop_zeros();
    }
    return true;
  }

  void drop_zeros() {
    const double small = std::numeric_limits<double>::epsilon() * weights_.cwiseAbs().maxCoeff();
    std::erase_if(passive_, [&](Index j) {
      if (either_sign_[static_cast<std::size_t>(j)] || weights_[j] > small) return false;
      weights_[j] = 0;
      return true;
    });
  }

  MatrixXd columns_;
  const VectorXd& target_;
  const std::vector<bool>& either_sign_;
  VectorXd lengths_, weights_;
  std::vector<Index> passive_, blocked_;
};

}  // namespace

NonNegativeSolution solve_non_negative(const MatrixXd& columns, const VectorXd& target,
                                       const std::vector<bool>& either_sign, const VectorXd& start) {
  return ActiveSet(columns, target, either_sign, start).solve();
}

}  // namespace dashpot::compiler::fitting
