// Least squares with weights that are zero or more.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dashpot::compiler::fitting {

struct NonNegativeSolution {
  Eigen::VectorXd weights;
  double residual_sum;  // ‖A x − b‖²
};

// min ‖A x − b‖² with x_j ≥ 0, but for those of either sign: the active-set method of Lawson & Hanson (1974, chapter
// 23), on columns scaled to length one; columns of length zero get the weight 0. The optimum is unique as a force.
// `start` may hold weights near the optimum, which then takes few rounds to find.
NonNegativeSolution solve_non_negative(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target,
                                       const std::vector<bool>& either_sign, const Eigen::VectorXd& start = {});

}  // namespace dashpot::compiler::fitting
